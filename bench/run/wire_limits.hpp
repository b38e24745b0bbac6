// Whether a scenario fits onto the bus: what a signal cannot carry would be saturated, or rounded to nothing,
// in silence.
#pragma once

#include "bench/run/initial_state.hpp"
#include "bench/scenario/seeker.hpp"
#include "bench/world/engagement/plan.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/imu_errors.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::run {

/// Every value within its signal's range, and no value but zero below its resolution. Error: one line.
Result<void> check_fits(const InitialState& state);

/// The IMU's sample interval [us] can be told exactly. Error: one line.
Result<void> check_fits_imu_interval(std::int64_t interval_us);

/// The increments of an IMU with these errors, on this flight, within their signals' ranges: by at most one
/// sample in 5e8, as a random part counts with six sigma. Error: one line, which names the key that
/// contributes most.
Result<void> check_fits(const world::ImuErrorModel& imu, const world::FlightRecord& truth);

/// The seeker's sample interval can be told exactly, the antenna's roll within an interval too; guidance
/// waits at least for a Sync cycle, which in lockstep is how long answers take to be heard. Error: one line.
Result<void> check_fits(const world::EngagementPlan& engagement, const scenario::Seeker& seeker);

}  // namespace canhil::run
