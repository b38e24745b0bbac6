#include "bench/checks/kinds/convergence.hpp"

#include <fmt/format.h>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/checks/not_finite.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {

Convergence Convergence::read(scenario::Section& section, const scenario::CheckContext& context) {
  Convergence rule;
  rule.judged = read_subject(section, context, [](const quantities::Quantity& quantity) {
    return quantity.degrees_of_freedom == 0 && !quantity.white && quantity.parts.empty();
  });
  std::tie(rule.within, rule.unit) =
      read_bar(section, "within", "Bound of |estimated - true|.", *rule.judged.quantity);
  rule.before_us = scenario::read_time(section,
                                       {"before_s",
                                        "Before this time, |estimated - true| must come within the bound, "
                                        "and then stay within the bound until the end of the run."},
                                       scenario::Limits::above(0), context.duration_us);
  rule.end_us = context.duration_us;
  return rule;
}

std::optional<Bar> Convergence::bar() const {
  return Bar{.judged = {judged},
             .stretch = {.window = {.from_us = before_us, .to_us = end_us}},
             .below = within,
             .statistic = "max"};
}

Finding Convergence::judge(const Evidence& evidence) const {
  const double before_s = static_cast<double>(before_us) * 1e-6;
  const Expected expected{
      .text = fmt::format("within {:g} {} for good before {:g} s", within / unit.factor, unit.name, before_s),
      .criterion = {.quantity = std::string(judged.quantity->name),
                    .estimator = judged.estimator,
                    .statistic = "time of convergence",
                    .upper = exclusive(before_s),
                    .unit = "s"}};
  const auto tracks = tracks_of(evidence, judged.estimator, *judged.quantity);
  if (tracks.empty()) return no_values(*judged.quantity, expected);
  const quantities::Track& track = *tracks.front();
  const Stretch to_the_end{.window = {before_us, evidence.truth.duration_us}};
  if (auto gap = no_evidence(track, to_the_end, inside(track, to_the_end, evidence), expected, evidence))
    return *gap;
  NotFinite not_finite;
  for (const quantities::TrackPoint& point : track.points) not_finite.take(point.t_us, point.value);
  if (auto why = not_finite.to_text(track.points.size()); !why.empty())
    return {Outcome::fail, std::move(why), expected};
  const auto t_us = entered_for_good_us(track.points, within,
                                        [](const quantities::TrackPoint& point) { return point.value; });
  if (!t_us) return {Outcome::fail, "not within at the end", expected};
  const double t_s = static_cast<double>(*t_us) * 1e-6;
  return {pass_if(*t_us < before_us),
          fmt::format("{:.2f} s", t_s),
          expected,
          {.value = t_s, .count = track.points.size()}};
}

}  // namespace canhil::checks
