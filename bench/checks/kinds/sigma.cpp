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
  const std::string expected = fmt::format("sigma between {:g} and {:g} {} {}", low / unit.factor,
                                           high / unit.factor, unit.name, to_text(stretch));
  const auto tracks = tracks_of(evidence, judged.estimator, *judged.quantity);
  if (tracks.empty()) return no_values(*judged.quantity, expected);
  const quantities::Track& track = *tracks.front();
  const Places part = inside(track, stretch, evidence);
  if (auto gap = no_evidence(track, stretch, part, expected, evidence)) return *gap;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::size_t without = 0;
  NotFinite not_finite;
  for (const std::size_t index : part) {
    const auto& [t_us, value, sigma, estimate, truth] = track.points[index];
    if (!sigma) {
      ++without;
      continue;
    }
    not_finite.take(t_us, *sigma);
    least = std::min(least, *sigma);
    most = std::max(most, *sigma);
  }
  if (without > 0)
    return {Outcome::fail, fmt::format("{} of {} answers have no sigma", without, part.size()), expected};
  if (auto why = not_finite.to_text(part.size(), "sigmas"); !why.empty())
    return {Outcome::fail, std::move(why), expected};
  const int digits = digits_of(unit, low);
  return {pass_if(least >= low && most <= high),
          fmt::format("{:.{}f} to {:.{}f} {} of {}", least / unit.factor, digits, most / unit.factor, digits,
                      unit.name, part.size()),
          expected};
}

}  // namespace canhil::checks
