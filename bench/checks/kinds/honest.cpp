#include "bench/checks/kinds/honest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/checks/evidence.hpp"
#include "bench/checks/not_finite.hpp"
#include "bench/quantities/list.hpp"
#include "bench/quantities/samples.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {

Honest Honest::read(scenario::Section& section, const scenario::CheckContext& context) {
  Honest rule;
  rule.estimators = running(context);
  std::erase_if(rule.estimators, [](const estimators::Estimator* one) {
    return !quantities::has(one->layout, quantities::trusted_over_sigma);
  });
  std::vector<std::string> names;
  for (const estimators::Estimator* one : rule.estimators) names.emplace_back(one->name);
  if (names.empty())
    section.reject("kind", fmt::format("'{}' is for estimators that report trusted.over_sigma", kind),
                   "another kind");
  section.optional("estimator");
  if (section.has("estimator")) {
    rule.named =
        section.one_of({"estimator", "Estimator to judge; by default all estimators that run."}, names);
    std::erase_if(rule.estimators, [&](const estimators::Estimator* one) { return one->name != rule.named; });
  }
  rule.over_sigma =
      section.plain_number({"over_sigma",
                            "Largest permitted ratio of error to sigma in a trusted answer. A trusted answer "
                            "has neither the mark `degraded` nor the mark `blind`."},
                           scenario::Limits::above(0), rule.over_sigma);
  return rule;
}

std::vector<std::string> Honest::held_against_truth() const {
  std::vector<std::string> names;
  for (const estimators::Estimator* one : estimators) names.emplace_back(one->name);
  return names;
}

Finding Honest::judge(const Evidence& evidence) const {
  Expected expected{
      .text = fmt::format("no error beyond {:g} sigma where the answer is not degraded", over_sigma),
      .criterion = {.quantity = std::string(quantities::trusted_over_sigma.name),
                    .estimator = named,
                    .statistic = "max",
                    .upper = Limit{.value = over_sigma},
                    .unit = "sigma"}};
  // The samples of a long run take seconds to compute, and an interrupted command must end at once.
  if (!evidence.ended_early.empty()) return {Outcome::not_measured, evidence.ended_early, expected};
  double worst = 0;
  std::int64_t at_us = 0;
  bool to_go = false;
  std::size_t judged = 0;
  for (const estimators::Estimator* one : estimators) {
    const quantities::Samples samples = one->samples(evidence.seen, evidence.truth);
    if (samples.empty()) return {Outcome::fail, fmt::format("{}: no answers to judge", one->name), expected};
    judged += samples.size();
    NotFinite not_finite;
    bool any_trusted = !quantities::has(one->layout, quantities::degraded);
    for (std::size_t index = 0; index < samples.size(); ++index) {
      const double ratio = samples.value(index, quantities::trusted_over_sigma);
      not_finite.take(samples.times()[index], ratio);
      any_trusted = any_trusted || samples.value(index, quantities::degraded) < 1;
      if (!(ratio > worst)) continue;
      worst = ratio;
      expected.criterion.estimator = one->name;
      at_us = samples.times()[index];
      to_go = one->layout.to_go_stretch_us > 0;
    }
    if (auto why = not_finite.to_text(samples.size(), "errors in sigmas", one->layout.to_go_stretch_us > 0);
        !why.empty())
      return {Outcome::fail, std::move(why), expected};
    if (!any_trusted)
      return {Outcome::not_measured,
              fmt::format("{}: all answers are degraded or blind, so none is trusted", one->name), expected};
  }
  const double at_s = static_cast<double>(at_us) * 1e-6;
  return {pass_if(worst <= over_sigma),
          fmt::format("{:.2f} sigma at {:g} s{}, the largest of {} errors", worst, to_go ? -at_s : at_s,
                      to_go ? " to go" : "", judged),
          std::move(expected),
          {.value = worst, .count = judged, .worst_at_us = to_go ? std::nullopt : std::optional(at_us)}};
}

}  // namespace canhil::checks
