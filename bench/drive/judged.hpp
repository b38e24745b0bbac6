// Judges what the bench observed in a flight. The flight took place in this run or comes from a recording.
#pragma once

#include "bench/drive/session.hpp"
#include "bench/faults/in_run.hpp"

namespace canhil::drive {

/// Returns the observations with higher upper limits for the target's counts (bad groups, late groups ...).
/// Each limit is raised by the number of events that the faults of the run may cause.
checks::Observations expecting(checks::Observations seen, const faults::Faults& faults,
                               const scenario::Scenario& scenario);

/// The ending of a run of a campaign, judged by the checks of every run if it was completed. If one fails, it
/// is `wrong_answers`. If one is not measured, or if the bench clipped a stimulus, it is `not_measured`. The
/// ending says why.
Ending ending_as_a_run(const Ending& ending, const scenario::Scenario& scenario,
                       const checks::Observations& seen, const PerRunTruth& per_run_truth);

/// The verdict on a flight, whether or not it was completed. `delays`: see checks::Evidence.
checks::Verdict verdict_of(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           const Collected& flown, const std::string& timing_unfit,
                           const checks::TargetDelays& delays = {});

}  // namespace canhil::drive
