#include "bench/checks/kinds/consistency.hpp"

#include <fmt/format.h>

#include "bench/checks/condition.hpp"
#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/checks/not_finite.hpp"
#include "bench/checks/probability.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {
namespace {

// If n independent values are chi-squared with k degrees of freedom each, their sum is chi-squared with n * k
// degrees of freedom. Their mean is this sum divided by n.
std::pair<double, double> interval(const Consistency& rule, std::size_t count) {
  if (const auto* between = std::get_if<MeanBetween>(&rule.bound)) return {between->low, between->high};
  const double probability = std::get<Probability>(rule.bound).value;
  const auto n = static_cast<double>(std::max<std::size_t>(count, 1));
  const double degrees_of_freedom = n * rule.judged.quantity->degrees_of_freedom;
  return {chi_squared_quantile(degrees_of_freedom, (1 - probability) / 2) / n,
          chi_squared_quantile(degrees_of_freedom, (1 + probability) / 2) / n};
}

}  // namespace

Consistency Consistency::read(scenario::Section& section, const scenario::CheckContext& context) {
  Consistency rule;
  rule.judged = read_subject(
      section, context, [](const quantities::Quantity& quantity) { return quantity.degrees_of_freedom > 0; });
  rule.window = scenario::read_window(section, context.duration_us);
  rule.condition = Condition::read(section, context, rule.judged.estimator);
  if (!section.has("probability")) {
    const auto [low, high] = section.interval({"mean_between", "The mean must lie between these two values."},
                                              scenario::Limits::at_least(0));
    rule.bound = MeanBetween{.low = low, .high = high};
    section.optional("probability");
    return rule;
  }
  section.refuse("mean_between", "is given beside probability", "one of the two");
  // Errors within one run are correlated in time, so the sum of their NEES is not chi-squared. Innovations
  // are white, so the sum of their NIS is chi-squared.
  if (!rule.judged.quantity->white)
    section.reject("probability", "is for innovations (NIS) only", "mean_between = [low, high]");
  rule.bound =
      Probability{.value = section.number({"probability",
                                           "Only for a NIS, in place of `mean_between`: the mean must lie in "
                                           "the central chi-square interval of this probability."},
                                          scenario::Limits::between(0.5, 0.999999))};
  return rule;
}

Finding Consistency::judge(const Evidence& evidence) const {
  const auto tracks = tracks_of(evidence, judged.estimator, *judged.quantity);
  const Stretch stretch{.window = window, .condition = condition};
  const Places part = tracks.empty() ? Places() : inside(*tracks.front(), stretch, evidence);
  const auto [low, high] = interval(*this, part.size());
  const Expected expected{
      .text = fmt::format("mean between {:.3g} and {:.3g} {}", low, high, to_text(stretch)),
      .criterion = {.quantity = std::string(judged.quantity->name),
                    .estimator = judged.estimator,
                    .statistic = "mean",
                    .lower = Limit{.value = low},
                    .upper = Limit{.value = high},
                    .stretch = stretch}};
  if (tracks.empty()) return no_values(*judged.quantity, expected);
  if (auto gap = no_evidence(*tracks.front(), stretch, part, expected, evidence)) return *gap;
  double sum = 0, largest = 0;
  std::int64_t largest_at_us = 0;
  NotFinite not_finite;
  for (const std::size_t index : part) {
    const quantities::TrackPoint& point = tracks.front()->points[index];
    sum += point.value;
    if (!(point.value <= largest)) {
      largest = point.value;
      largest_at_us = point.t_us;
    }
    not_finite.take(point.t_us, point.value);
  }
  if (auto why = not_finite.to_text(part.size()); !why.empty())
    return {Outcome::fail, std::move(why), expected};
  const double mean = sum / static_cast<double>(part.size());
  const bool too_small = mean < low;  // then no single value is the worst
  return {pass_if(mean >= low && mean <= high),
          fmt::format("mean {:.3f} of {}", mean, part.size()),
          expected,
          {.value = mean,
           .count = part.size(),
           .worst_at_us = too_small ? std::nullopt : std::optional(largest_at_us)}};
}

}  // namespace canhil::checks
