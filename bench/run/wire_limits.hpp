// Whether a scenario fits onto the bus: what a signal cannot carry would be saturated, or rounded to nothing,
// in silence.
#pragma once

#include "bench/run/initial_state.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::run {

/// Every value within its signal's range, and no value but zero below its resolution. Error: one line.
Result<void> check_fits(const InitialState& state);

/// The IMU's sample interval [us] can be told exactly. Error: one line.
Result<void> check_fits_imu_interval(std::int64_t interval_us);

}  // namespace canhil::run
