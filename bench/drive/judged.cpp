#include "bench/drive/judged.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/estimators/of_scenario.hpp"
#include "bench/estimators/registry.hpp"

namespace canhil::drive {

checks::Observations expecting(checks::Observations seen, const faults::Faults& faults,
                               const scenario::Scenario& scenario) {
  std::int64_t latency_us = 0;
  for (const scenario::NodeSettings& node : scenario.nodes)
    latency_us = std::max(latency_us, node.latency_us());
  for (faults::FaultReport& fault : faults.reports()) {
    // Checks that name a fault which never began find it, and that it did not strike.
    if (fault.windows.empty())
      fault.windows = {{.from_us = scenario.duration_us, .to_us = scenario.duration_us}};
    for (const auto& [from_us, to_us] : fault.windows)
      seen.faults.push_back({.name = fault.name,
                             .window = {from_us, to_us},
                             .valid_from_us = std::max<std::int64_t>(from_us - latency_us, 0),
                             .of_target = fault.stage == faults::Stage::target,
                             .count = fault.count});
  }
  // An estimator may reject a group because of a changed value. A changed order may make a group late. If a
  // fault moves a time of validity into the future, all groups up to that time are late.
  const faults::Tally tally = faults.tally();
  seen.expected_counts.most.bad_group += tally.changed * scenario.targets.size();
  seen.expected_counts.most.late += tally.overtaken * scenario.targets.size();
  if (tally.changed_times > 0)
    seen.expected_counts.most.late = seen.expected_counts.most.bad_group = checks::any_count;
  return seen;
}

Ending ending_as_a_run(const Ending& ending, const scenario::Scenario& scenario,
                       const checks::Observations& seen, const PerRunTruth& per_run_truth) {
  if (ending.kind != Ending::Kind::completed) return ending;
  const std::vector<checks::CheckResult> found =
      checks::of_every_run(scenario, seen, plants_of(per_run_truth));
  if (found.empty()) return ending;
  // A flight whose stimuli the bench clipped is impossible, whatever the target answered.
  const bool fails = seen.clipped.empty() &&
                     checks::outcome_of(found, &checks::CheckResult::outcome) == checks::Outcome::fail;
  Ending judged = ending;
  judged.kind = fails ? Ending::Kind::wrong_answers : Ending::Kind::not_measured;
  for (const checks::CheckResult& check : found) {
    judged.detail += fmt::format("{}{}: {}", judged.detail.empty() ? "" : "; ", check.kind, check.measured);
  }
  return judged;
}

checks::Verdict verdict_of(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           const Collected& flown, const std::string& timing_unfit,
                           const checks::TargetDelays& delays) {
  const bool to_the_end = flown.ending.kind == Ending::Kind::wrong_end;
  checks::Verdict verdict =
      checks::judge(scenario, {.seen = flown.seen,
                               .truth = truth_of(truth, flown.per_run_truth, scenario.duration_us),
                               .estimators = estimators::in(scenario),
                               .ended_early = to_the_end ? "" : flown.ending.detail,
                               .timing_unfit = timing_unfit,
                               .delays = delays});
  if (to_the_end) checks::conclude(verdict, flown.ending.detail);
  if (flown.ending.kind == Ending::Kind::interrupted || flown.ending.kind == Ending::Kind::plant_failed)
    verdict.outcome = checks::Outcome::not_measured;
  return verdict;
}

}  // namespace canhil::drive
