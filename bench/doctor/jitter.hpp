// How late this machine wakes a process that asked for a time.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/checks/timing.hpp"
#include "bench/doctor/line.hpp"

namespace canhil::doctor {

inline constexpr std::int64_t jitter_period_ns = 1'000'000;

/// Wakes at absolute times of CLOCK_MONOTONIC, one a millisecond, for `duration_ns` or until stop(), and
/// takes the time after each: cyclictest's method. Returns how late each was [s].
std::vector<double> measure_jitter(std::int64_t duration_ns, const std::function<bool()>& stop);

/// Its figures; `conditions`: how it was measured.
Line jitter_line(const std::vector<double>& late_s, const std::string& conditions);

/// Mean of a sample; 0 of none.
double mean(const std::vector<double>& sample);

}  // namespace canhil::doctor
