// The checks of a scenario against what was seen.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/evidence.hpp"
#include "bench/checks/verdict.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::checks {

/// Judges every check of the scenario. A run that ended early fails, whatever its checks say.
Verdict judge(const scenario::Scenario& scenario, Evidence evidence);

/// Whether judge() adds a check of this kind where it does not pass, though the scenario has none.
bool is_implied(std::string_view kind);

/// The windows, each once, for which the checks ask for the timing of a message: empty, to be filled.
std::vector<TimedWindow> timed_windows(const std::vector<scenario::Check>& checks,
                                       std::span<const MessageInfo> messages = messages::all_messages);

/// Every kind of check that a scenario may have: those of this folder and the estimators' own.
std::vector<scenario::CheckKind> kinds(std::span<const estimators::Estimator* const> estimators);
/// Those of before, each with what is written in its place now.
std::vector<scenario::FormerCheckKind> former_kinds(std::span<const estimators::Estimator* const> estimators);

/// Why no timing of this run can be judged: frames of the target were lost on the way. Empty: it can, as far
/// as the bench kept its own deadlines, which each check asks by its bar.
std::string unfit_for_timing(const Observations& seen);

}  // namespace canhil::checks
