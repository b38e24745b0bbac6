// The timer jitter: how late this machine wakes a process.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/checks/timing.hpp"
#include "bench/doctor/line.hpp"

namespace canhil::doctor {

inline constexpr std::int64_t jitter_period_ns = 1'000'000;

/// Wakes at absolute times of CLOCK_MONOTONIC, once per millisecond, for `duration_ns` or until stop(), and
/// reads the time after each: the method of cyclictest. Returns the lateness of each wake-up [s].
std::vector<double> measure_jitter(std::int64_t duration_ns, const std::function<bool()>& stop);

/// The line for these values; `conditions`: how they were measured.
Line jitter_line(const std::vector<double>& late_s, const std::string& conditions);

/// Mean of a sample; 0 if empty.
double mean(const std::vector<double>& sample);

}  // namespace canhil::doctor
