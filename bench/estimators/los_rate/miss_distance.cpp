#include "bench/estimators/los_rate/miss_distance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/checks/evidence.hpp"
#include "bench/estimators/los_rate/los_rate.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::estimators {

MissDistance MissDistance::read(scenario::Section& section, const scenario::CheckContext& context) {
  if (std::ranges::find(context.estimators, los_rate.name) == context.estimators.end())
    section.reject("kind", "needs an engagement to be judged", "estimator los_rate in the scenario");
  return {.below = section.number({"below_m", "The closest approach must be below this value."},
                                  scenario::Limits::above(0))};
}

std::vector<std::string> MissDistance::held_against_truth() const { return {std::string(los_rate.name)}; }

checks::Finding MissDistance::judge(const checks::Evidence& evidence) const {
  using checks::Outcome;
  const std::string expected = fmt::format("miss < {:g} m", below);
  const world::EngagementRecord* engagement = evidence.truth.engagement;
  if (engagement == nullptr || !engagement->miss_n)
    return {Outcome::fail, "the missile did not pass the target before the end", expected};
  const double miss = engagement->miss_n->norm();
  return {checks::pass_if(miss < below), fmt::format("{:.3f} m", miss), expected};
}

}  // namespace canhil::estimators
