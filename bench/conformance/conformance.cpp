#include "bench/conformance/conformance.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace canhil::conformance {
namespace {

using namespace messages;

// Returns an algorithm with which the target accepts the estimator of the scenario. First tries the
// scenario's own algorithm, then all algorithms of the DBC. Returns nullopt if the target does not have this
// estimator.
std::optional<Algorithm> algorithm_of(Talk& talk) {
  TargetCommand reset = talk.command(Command::reset);
  std::vector<Algorithm> candidates{reset.algorithm};
  candidates.insert(candidates.end(), enumerators<Algorithm>.begin(), enumerators<Algorithm>.end());
  for (const Algorithm algorithm : candidates) {
    reset.algorithm = algorithm;
    talk.send(reset);
    const auto beat = talk.hear<TargetHeartbeat>([&](const auto& one) {
      return one.algorithm == algorithm && (one.estimator == reset.estimator || one.error_command != 0);
    });
    if (beat && beat->error_command == 0 && beat->estimator == reset.estimator) return algorithm;
  }
  return std::nullopt;
}

}  // namespace

Result<std::vector<checks::CheckResult>> ask(const std::vector<Rule>& rules,
                                             const scenario::Scenario& scenario, const std::string& target,
                                             std::span<const Parameter> parameters,
                                             const std::optional<std::pair<std::string, double>>& apply,
                                             const std::atomic<bool>& stop,
                                             const std::function<void(const Rule&)>& progress) {
  auto talk = Talk::open(scenario, target, stop);
  if (!talk) return tl::unexpected(talk.error());
  Subject subject{.talk = **talk, .parameters = parameters, .apply = apply};
  std::vector<checks::CheckResult> results;
  for (const Rule& rule : rules) {
    if (stop) break;
    progress(rule);
    const std::string before = (*talk)->gone();
    std::string wrong = before.empty() ? rule.ask(subject) : before;
    // The process must run until the bench ends it, here after the last rule.
    const std::string after = results.size() + 1 < rules.size() ? (*talk)->gone() : (*talk)->end();
    if (before.empty() && !after.empty()) wrong += (wrong.empty() ? "" : "; ") + after;
    results.push_back({.name = rule.id,
                       .kind = rule.family,
                       .requirement = rule.id,
                       .outcome = wrong.empty() ? checks::Outcome::pass : checks::Outcome::fail,
                       .measured = wrong.empty() ? "as expected" : wrong,
                       .expected = rule.text});
  }
  return results;
}

Result<void> find_target(const scenario::Scenario& scenario, const std::string& target,
                         const std::atomic<bool>& stop) {
  const auto talk = Talk::open(scenario, target, stop);
  return talk ? Result<void>{} : tl::unexpected(talk.error());
}

Result<scenario::Scenario> subject_of(const std::vector<scenario::Scenario>& candidates,
                                      const std::string& target, const std::atomic<bool>& stop) {
  std::vector<std::string> names;
  for (const scenario::Scenario& candidate : candidates) {
    scenario::Scenario chosen = candidate;
    chosen.targets.resize(1);
    chosen.targets.front().parameters.clear();  // parameters differ between targets
    auto talk = Talk::open(chosen, target, stop);
    if (!talk) return tl::unexpected(talk.error());
    scenario::TargetSetup& setup = chosen.targets.front();
    const auto beat = (*talk)->hear<TargetHeartbeat>([](const auto&) { return true; });
    names.push_back(setup.estimator);
    if (beat && beat->estimator != Estimator::none && name_of(beat->estimator) != setup.estimator) continue;
    const auto algorithm = algorithm_of(**talk);
    if (!algorithm) continue;
    setup.algorithm = std::string(name_of(*algorithm));
    return chosen;
  }
  if (stop) return failure("interrupted");
  return failure(
      fmt::format("target '{}': accepts none of the estimators {}", target, fmt::join(names, ", ")));
}

}  // namespace canhil::conformance
