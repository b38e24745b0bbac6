// Whether a target keeps the protocol: the rules, asked of a program over an embedded bus of its own.
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

/// A rule, and what was wrong; empty: nothing.
struct Finding {
  Rule rule;
  std::string wrong;
};

/// Asks the rules, one after another, of a program that is started for it. `scenario`: whose estimator the
/// target is to be. Error: it does not start.
Result<std::vector<Finding>> ask(
    const std::vector<Rule>& rules, const scenario::Scenario& scenario, const std::string& target,
    std::span<const Parameter> parameters, const std::optional<std::pair<std::string, double>>& apply,
    const std::atomic<bool>& stop, const std::function<void(const Rule&)>& progress = [](const Rule&) {});

/// The scenario, with the algorithm and without parameters, as whose estimator a target can be talked to:
/// what its heartbeat names, else the first of the candidates that it takes. Error: it does not start, or
/// takes none.
Result<scenario::Scenario> subject_of(const std::vector<scenario::Scenario>& candidates,
                                      const std::string& target);

/// What was found of one target.
struct Report {
  std::string target;  ///< its command
  std::string estimator, algorithm;
  std::vector<Finding> findings;
  double wall_s = 0;
  std::int64_t started_s = 0;  ///< since 1970, UTC
  [[nodiscard]] checks::Outcome outcome() const;
};

/// A line a rule; what was wrong below it.
std::string text(const Report& report);
std::string json(const Report& report);
std::string junit(const Report& report);

}  // namespace canhil::conformance
