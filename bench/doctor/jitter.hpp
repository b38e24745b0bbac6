// The timer jitter: how late this machine wakes a sleeping process.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/checks/timing.hpp"
#include "bench/doctor/line.hpp"

namespace canhil::doctor {

inline constexpr std::int64_t jitter_period_ns = 1'000'000;

/// Works like cyclictest: once per millisecond, sleeps until an absolute time of CLOCK_MONOTONIC, then reads
/// the clock. Ends after `duration_ns`, or when stop() returns true. Returns how late each wake-up was [s].
std::vector<double> measure_jitter(std::int64_t duration_ns, const std::function<bool()>& stop);

/// The finding about the lateness values `late_s`. `conditions` describes the conditions of the measurement.
Line jitter_line(const std::vector<double>& late_s, const std::string& conditions);

/// The mean of the numbers in `sample`; 0 if there are none.
double mean(const std::vector<double>& sample);

}  // namespace canhil::doctor
