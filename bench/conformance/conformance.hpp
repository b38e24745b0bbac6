// Tests whether a target program keeps the protocol, over a private embedded bus.
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

/// The result of testing a rule. `wrong`: how the target violated the rule; empty: the target kept it.
struct Finding {
  Rule rule;
  std::string wrong;
};

/// Starts the target and tests the rules one after another. `scenario` selects the estimator. Error: the
/// target does not start.
Result<std::vector<Finding>> ask(
    const std::vector<Rule>& rules, const scenario::Scenario& scenario, const std::string& target,
    std::span<const Parameter> parameters, const std::optional<std::pair<std::string, double>>& apply,
    const std::atomic<bool>& stop, const std::function<void(const Rule&)>& progress = [](const Rule&) {});

/// Chooses from the candidates the scenario for testing the target. If the target's heartbeat names an
/// estimator, this is the candidate for that estimator; otherwise it is the first candidate whose estimator
/// the target accepts. The result has an algorithm that the target accepts, and no parameters. Error: the
/// target does not start, or accepts no candidate.
Result<scenario::Scenario> subject_of(const std::vector<scenario::Scenario>& candidates,
                                      const std::string& target);

/// The findings for one target.
struct Report {
  std::string target;  ///< command of the target
  std::string estimator, algorithm;
  std::vector<Finding> findings;
  double wall_s = 0;
  std::int64_t started_s = 0;  ///< since 1970, UTC
  [[nodiscard]] checks::Outcome outcome() const;
};

/// One line for each rule, followed by its violation.
std::string text(const Report& report);
std::string json(const Report& report);
std::string junit(const Report& report);

}  // namespace canhil::conformance
