// What a flight's observations come to, whether it is flown or was recorded.
#pragma once

#include "bench/drive/session.hpp"
#include "bench/faults/in_run.hpp"

namespace canhil::drive {

/// The observations with what the faults of the run make a target count.
checks::Observations expecting(checks::Observations seen, const faults::Faults& faults,
                               const scenario::Scenario& scenario);

/// Of a flight that came to its end, or did not.
checks::Verdict verdict_of(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           const Collected& flown, const std::string& timing_unfit);

}  // namespace canhil::drive
