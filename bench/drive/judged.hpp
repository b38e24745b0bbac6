// Judges the observations of a flight, simulated or recorded.
#pragma once

#include "bench/drive/session.hpp"
#include "bench/faults/in_run.hpp"

namespace canhil::drive {

/// The observations. The upper limits of the target's counts (bad groups, late groups ...) are raised by the
/// numbers that the faults of the run may cause.
checks::Observations expecting(checks::Observations seen, const faults::Faults& faults,
                               const scenario::Scenario& scenario);

/// The verdict on a flight, whether or not it was completed.
checks::Verdict verdict_of(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           const Collected& flown, const std::string& timing_unfit);

}  // namespace canhil::drive
