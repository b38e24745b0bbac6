#include "bench/estimators/los_rate/miss_distance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/checks/estimator.hpp"
#include "bench/checks/evidence.hpp"
#include "bench/estimators/end_of_flight.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::estimators {

MissDistance MissDistance::read(scenario::Section& section, const scenario::CheckContext& context) {
  MissDistance rule;
  for (const Estimator* one : context.contract.known) {
    const bool runs = std::ranges::find(context.estimators, one->name) != context.estimators.end();
    if (runs && std::ranges::any_of(one->of_runs, &quantities::Quantity::has_time_to_go))
      rule.estimators.emplace_back(one->name);
  }
  if (rule.estimators.empty())
    section.reject("kind", "needs a missile and its target to be judged",
                   "estimator los_rate in the scenario");
  rule.below = section.number({"below_m", "The closest approach must be below this value."},
                              scenario::Limits::above(0));
  return rule;
}

std::vector<std::string> MissDistance::held_against_truth() const { return estimators; }

checks::Finding MissDistance::judge(const checks::Evidence& evidence) const {
  using checks::Outcome;
  const checks::Expected expected{
      .text = fmt::format("miss < {:g} m", below),
      .criterion = {.quantity = "miss.distance", .upper = checks::exclusive(below), .unit = "m"}};
  const auto end = Passage::find(evidence.truth.plants);
  if (!end || !end->miss_n)
    return {Outcome::fail, "the missile did not pass the target before the end", expected};
  const double miss = end->miss_n->norm();
  return {checks::pass_if(miss < below),
          fmt::format("{:.3f} m", miss),
          expected,
          {.value = miss, .worst_at_us = end->t_us}};
}

}  // namespace canhil::estimators
