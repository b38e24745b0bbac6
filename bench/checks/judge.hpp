// Judges the checks of a scenario against what the bench observed.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/evidence.hpp"
#include "bench/checks/verdict.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::checks {

/// Judges every check of the scenario. A run that ended early fails, regardless of its checks.
Verdict judge(const scenario::Scenario& scenario, Evidence evidence);

/// The checks that apply to every run, except for that of the bus: those that do not pass. `plants`: of a
/// completed run.
std::vector<CheckResult> of_every_run(const scenario::Scenario& scenario, const Observations& seen,
                                      const world::PlantRecords& plants);

/// Whether a check of this kind is implied: judge() adds the check although the scenario does not contain it.
/// The verdict lists an implied check only if the check does not pass.
bool is_implied(std::string_view kind);

/// The windows, without duplicates, in which checks need the timing of a message. The windows contain no
/// times yet; observe::Stopwatch adds the times during the run.
std::vector<TimedWindow> timed_windows(const std::vector<scenario::Check>& checks,
                                       std::span<const MessageInfo> messages = messages::all_messages);

/// Every kind of check that a scenario may have: kinds of this folder and kinds of the estimators.
std::vector<scenario::CheckKind> kinds(std::span<const estimators::Estimator* const> estimators);

/// Why no timing of this run can be judged, for example because frames of the target were lost. Empty: timing
/// can be judged if the bench kept its own deadlines. Each check examines the lateness of the bench against
/// the limit of the check.
std::string unfit_for_timing(const Observations& seen);

}  // namespace canhil::checks
