#include "bench/drive/judged.hpp"

#include "bench/estimators/of_scenario.hpp"
#include "bench/estimators/registry.hpp"

namespace canhil::drive {

checks::Observations expecting(checks::Observations seen, const faults::Faults& faults,
                               const scenario::Scenario& scenario) {
  // An estimator may reject a group because of a changed value. A changed order may make a group late. If a
  // fault moves a time of validity into the future, all groups up to that time are late.
  const faults::Tally tally = faults.tally();
  seen.expected_counts.most.bad_group += tally.changed * scenario.targets.size();
  seen.expected_counts.most.late += tally.overtaken * scenario.targets.size();
  if (tally.changed_times > 0)
    seen.expected_counts.most.late = seen.expected_counts.most.bad_group = checks::any_count;
  return seen;
}

checks::Verdict verdict_of(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           const Collected& flown, const std::string& timing_unfit) {
  const bool to_the_end = flown.ending.kind == Ending::Kind::wrong_end;
  checks::Verdict verdict =
      checks::judge(scenario, {.seen = flown.seen,
                               .truth = truth_of(truth, flown.per_run_truth, scenario.duration_us),
                               .estimators = estimators::in(scenario),
                               .ended_early = to_the_end ? "" : flown.ending.detail,
                               .timing_unfit = timing_unfit});
  if (to_the_end) checks::conclude(verdict, flown.ending.detail);
  if (flown.ending.kind == Ending::Kind::interrupted) verdict.outcome = checks::Outcome::not_measured;
  return verdict;
}

}  // namespace canhil::drive
