// Judges the observations of a flight, simulated or recorded.
#pragma once

#include "bench/drive/session.hpp"
#include "bench/faults/in_run.hpp"

namespace canhil::drive {

/// The observations, extended by the counts that the faults of the run cause in a target.
checks::Observations expecting(checks::Observations seen, const faults::Faults& faults,
                               const scenario::Scenario& scenario);

/// The verdict on a flight, whether or not it was completed.
checks::Verdict verdict_of(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           const Collected& flown, const std::string& timing_unfit);

}  // namespace canhil::drive
