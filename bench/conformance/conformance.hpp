// Tests, over a private embedded bus, whether a target program follows the protocol.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/checks/verdict.hpp"
#include "bench/conformance/rules.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::conformance {

/// Starts the target and tests the rules one after another. `scenario` selects the estimator. A rule is also
/// violated if the target's process ends during it, or if it ends with an error when the bench ends it after
/// the last rule. The results have the rule's id as name and requirement, its family as kind and its text as
/// expectation; `measured` states how the target violated the rule. Returns an error if the target does not
/// start.
Result<std::vector<checks::CheckResult>> ask(
    const std::vector<Rule>& rules, const scenario::Scenario& scenario, const std::string& target,
    std::span<const Parameter> parameters, const std::optional<std::pair<std::string, double>>& apply,
    const std::atomic<bool>& stop, const std::function<void(const Rule&)>& progress = [](const Rule&) {});

/// Starts the target and waits for a heartbeat. Returns an error if it does not start or sends none.
Result<void> find_target(const scenario::Scenario& scenario, const std::string& target,
                         const std::atomic<bool>& stop);

/// Chooses one of the candidates as the scenario with which the target is tested. If the target's heartbeat
/// names an estimator, the choice is the candidate for that estimator; otherwise it is the first candidate
/// whose estimator the target accepts. The returned scenario has an algorithm that the target accepts, and no
/// parameters. Returns an error if the target does not start, or accepts no candidate.
Result<scenario::Scenario> subject_of(const std::vector<scenario::Scenario>& candidates,
                                      const std::string& target, const std::atomic<bool>& stop);

/// The findings for one target.
struct Report {
  std::string target;  ///< command of the target
  std::string estimator, algorithm;
  std::vector<checks::CheckResult> rules;
  double wall_s = 0;
  std::int64_t started_s = 0;  ///< start of the test, in seconds since 1970, UTC
  [[nodiscard]] checks::Outcome outcome() const {
    return checks::outcome_of(rules, &checks::CheckResult::outcome);
  }
};

}  // namespace canhil::conformance
