// The timer jitter: the delay with which this machine wakes a process.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/checks/timing.hpp"
#include "bench/doctor/line.hpp"

namespace canhil::doctor {

inline constexpr std::int64_t jitter_period_ns = 1'000'000;

/// Sleeps until absolute times of CLOCK_MONOTONIC, once per millisecond, for `duration_ns` or until stop(),
/// and reads the clock after each wake-up, as cyclictest does. Returns the lateness of each wake-up [s].
std::vector<double> measure_jitter(std::int64_t duration_ns, const std::function<bool()>& stop);

/// The finding for these values; `conditions`: under which they were measured.
Line jitter_line(const std::vector<double>& late_s, const std::string& conditions);

/// Mean of a sample; 0 if empty.
double mean(const std::vector<double>& sample);

}  // namespace canhil::doctor
