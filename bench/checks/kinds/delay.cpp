#include "bench/checks/kinds/delay.hpp"

#include <fmt/format.h>

#include "bench/checks/delay.hpp"
#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/checks/not_finite.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {

DelayBelow DelayBelow::read(scenario::Section& section, const scenario::CheckContext& context) {
  DelayBelow rule;
  rule.judged = read_subject(section, context, [](const quantities::Quantity& quantity) {
    return quantity.degrees_of_freedom == 0 && !quantity.white && quantity.parts.empty();
  });
  rule.window = scenario::read_window(section, context.duration_us);
  rule.below_us =
      section.time_us({"below_ms", "The delay must be below this value."}, scenario::Limits::above(0));
  return rule;
}

Finding DelayBelow::judge(const Evidence& evidence) const {
  const double bar_s = 1e-6 * static_cast<double>(below_us);
  const Stretch stretch{.window = window};
  const Expected expected{
      .text = fmt::format("reported less than {:g} ms late {}", bar_s * 1e3, seconds(window)),
      .criterion = {.quantity = std::string(judged.quantity->name),
                    .estimator = judged.estimator,
                    .statistic = "delay",
                    .upper = exclusive(bar_s * 1e3),
                    .unit = "ms",
                    .stretch = stretch}};
  const auto tracks = tracks_of(evidence, judged.estimator, *judged.quantity);
  if (tracks.empty()) return no_values(*judged.quantity, expected);
  NotFinite not_finite;
  const Places part = inside(*tracks.front(), stretch, evidence);
  if (auto gap = no_evidence(*tracks.front(), stretch, part, expected, evidence)) return *gap;
  for (const std::size_t index : part) {
    const quantities::TrackPoint& point = tracks.front()->points[index];
    not_finite.take(point.t_us, point.estimate.value_or(0));
  }
  if (auto why = not_finite.to_text(part.size()); !why.empty())
    return {Outcome::fail, std::move(why), expected};
  const auto delay = delay_of(*tracks.front(), window);
  if (!delay) return {Outcome::not_measured, delay.error().message, expected};
  const std::string measured =
      fmt::format("{:.1f} +- {:.1f} ms", delay->delay_s * 1e3, delay->half_width_s * 1e3);
  const Measurement measurement{.value = delay->delay_s * 1e3, .count = part.size()};
  if (delay->delay_s + delay->half_width_s < bar_s) {
    // Each value counts at the latest possible sample, so the delay may be longer.
    const std::string why = why_uncertain(evidence, judged.estimator, *judged.quantity);
    if (!why.empty()) return {Outcome::not_measured, measured + " or more: " + why, expected};
    return {Outcome::pass, measured, expected, measurement};
  }
  if (delay->delay_s - delay->half_width_s >= bar_s) return {Outcome::fail, measured, expected, measurement};
  return {Outcome::not_measured, measured + ", too uncertain to compare with the limit", expected,
          measurement};
}

}  // namespace canhil::checks
