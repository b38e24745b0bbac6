// Tests whether a target program keeps the protocol, over an embedded bus of its own.
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

/// A rule and how it was violated; empty: not violated.
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

/// The scenario for testing the target, with an accepted algorithm and without parameters: for the estimator
/// in the target's heartbeat, otherwise for the first accepted one of the candidates. Error: the target does
/// not start, or accepts none.
Result<scenario::Scenario> subject_of(const std::vector<scenario::Scenario>& candidates,
                                      const std::string& target);

/// The findings for one target.
struct Report {
  std::string target;  ///< its command
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
