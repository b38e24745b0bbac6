#include "bench/checks/kinds/sigma.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/checks/not_finite.hpp"

namespace canhil::checks {

Sigma Sigma::read(scenario::Section& section, const scenario::CheckContext& context) {
  Sigma rule;
  rule.judged = read_subject(section, context, [](const quantities::Quantity& quantity) {
    return quantity.degrees_of_freedom == 0 && !quantity.white && quantity.parts.empty();
  });
  rule.stretch = read_stretch(section, context, rule.judged);
  const auto [range, unit] =
      read_range(section, "between", "Every sigma must lie between these two values.", *rule.judged.quantity);
  std::tie(rule.low, rule.high) = range;
  rule.unit = unit;
  return rule;
}

Finding Sigma::judge(const Evidence& evidence) const {
  const Expected expected{.text = fmt::format("sigma between {:g} and {:g} {} {}", low / unit.factor,
                                              high / unit.factor, unit.name, to_text(stretch)),
                          .criterion = {.quantity = std::string(judged.quantity->name),
                                        .estimator = judged.estimator,
                                        .statistic = "sigma",
                                        .lower = Limit{.value = low / unit.factor},
                                        .upper = Limit{.value = high / unit.factor},
                                        .unit = std::string(unit.name),
                                        .stretch = stretch}};
  const auto tracks = tracks_of(evidence, judged.estimator, *judged.quantity);
  if (tracks.empty()) return no_values(*judged.quantity, expected);
  const quantities::Track& track = *tracks.front();
  const Places part = inside(track, stretch, evidence);
  if (auto gap = no_evidence(track, stretch, part, expected, evidence)) return *gap;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::int64_t least_at_us = 0, most_at_us = 0;
  std::size_t without = 0;
  NotFinite not_finite;
  for (const std::size_t index : part) {
    const auto& [t_us, value, sigma, estimate, truth] = track.points[index];
    if (!sigma) {
      ++without;
      continue;
    }
    not_finite.take(t_us, *sigma);
    if (*sigma < least) {
      least = *sigma;
      least_at_us = t_us;
    }
    if (*sigma > most) {
      most = *sigma;
      most_at_us = t_us;
    }
  }
  if (without > 0)
    return {Outcome::fail, fmt::format("{} of {} answers have no sigma", without, part.size()), expected};
  if (auto why = not_finite.to_text(part.size(), "sigmas"); !why.empty())
    return {Outcome::fail, std::move(why), expected};
  const int digits = digits_of(unit, low);
  Finding finding{pass_if(least >= low && most <= high),
                  fmt::format("{:.{}f} to {:.{}f} {} of {}", least / unit.factor, digits, most / unit.factor,
                              digits, unit.name, part.size()),
                  expected};
  const auto judgement = [&](double sigma, std::int64_t at_us) -> Judgement {
    return {.criterion = expected.criterion,
            .measurement = {.value = sigma / unit.factor, .count = part.size(), .worst_at_us = at_us}};
  };
  take_nearest_to_limit(finding, {judgement(least, least_at_us), judgement(most, most_at_us)});
  return finding;
}

}  // namespace canhil::checks
