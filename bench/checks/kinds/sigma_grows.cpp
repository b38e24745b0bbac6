#include "bench/checks/kinds/sigma_grows.hpp"

#include <fmt/format.h>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_faults.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/checks/not_finite.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {

SigmaGrows SigmaGrows::read(scenario::Section& section, const scenario::CheckContext& context) {
  SigmaGrows rule;
  rule.judged = read_subject(section, context, [](const quantities::Quantity& quantity) {
    return quantity.degrees_of_freedom == 0 && !quantity.white && quantity.parts.empty();
  });
  if (const auto fault = read_fault(section, context)) {
    for (const std::string_view key : {"from_s", "to_s"})
      section.refuse(key, "has no effect beside fault", "one of the two");
    rule.fault = fault->fault;
    rule.window = {.from_us = fault->valid_from_us, .to_us = fault->window.to_us};
  } else {
    rule.window = scenario::read_window(section, context.duration_us);
  }
  rule.by = section.plain_number({"by",
                                  "The last sigma of the window, divided by the last sigma before the "
                                  "window, must be more than this value."},
                                 scenario::Limits::at_least(1), 1);
  return rule;
}

Finding SigmaGrows::judge(const Evidence& evidence) const {
  const Stretch stretch{.window = window};
  const Expected expected{
      .text = fmt::format("sigma grows to more than {:g} times {}", by,
                          fault.empty() ? seconds(window) : fmt::format("through fault '{}'", fault)),
      .criterion = {.quantity = std::string(judged.quantity->name),
                    .estimator = judged.estimator,
                    .statistic = "growth of sigma",
                    .lower = exclusive(by),
                    .stretch = stretch}};
  if (auto why = did_not_strike(evidence, fault); !why.empty())
    return {Outcome::not_measured, std::move(why), expected};
  const auto tracks = tracks_of(evidence, judged.estimator, *judged.quantity);
  if (tracks.empty()) return no_values(*judged.quantity, expected);
  if (fault.empty()) {  // a fault may leave nothing to be answered
    if (auto gap = no_evidence(*tracks.front(), stretch, inside(*tracks.front(), stretch, evidence), expected,
                               evidence))
      return *gap;
  }
  // The reference is the last sigma before the window or, if there is none, the first sigma in the window.
  std::optional<double> first, last;
  std::size_t in_window = 0, sigmas = 0;
  NotFinite not_finite;
  for (const quantities::TrackPoint& point : tracks.front()->points) {
    if (!point.sigma || point.t_us > window.to_us) continue;
    not_finite.take(point.t_us, *point.sigma);
    ++sigmas;
    if (point.t_us <= window.from_us || !first) first = point.sigma;
    last = point.sigma;
    if (point.t_us > window.from_us) ++in_window;
  }
  if (in_window == 0) return {Outcome::fail, "no sigma is reported in it", expected};
  if (auto why = not_finite.to_text(sigmas, "sigmas"); !why.empty())
    return {Outcome::fail, std::move(why), expected};
  const quantities::Unit& unit = judged.quantity->unit;
  const int digits = digits_of(unit, *first);
  return {pass_if(*last > by * *first),
          fmt::format("{:.{}f} to {:.{}f} {}", *first / unit.factor, digits, *last / unit.factor, digits,
                      unit.name),
          expected,
          {.value = *first > 0 ? std::optional(*last / *first) : std::nullopt, .count = in_window}};
}

}  // namespace canhil::checks
