#include "bench/checks/kinds/detected_within.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/checks/evidence.hpp"

namespace canhil::checks {

DetectedWithin DetectedWithin::read(scenario::Section& section, const scenario::CheckContext& context) {
  DetectedWithin rule;
  rule.disturbance = read_disturbance(section, context);
  rule.within_us = read_within(section, context, rule.disturbance.window.from_us,
                               "Longest permitted time from the onset to the first sign.");
  rule.by = read_signs(section, context);
  return rule;
}

Finding DetectedWithin::judge(const Evidence& evidence) const {
  const auto seconds_of = [](std::int64_t t_us) { return static_cast<double>(t_us) * 1e-6; };
  const std::int64_t onset_us = disturbance.window.from_us;
  const Expected expected{
      .text = fmt::format("{} within {:g} s of {}",
                          by.empty() ? "a sign" : fmt::format("{}", fmt::join(by, ", ")),
                          seconds_of(within_us), disturbance.to_text()),
      .criterion = {.quantity = disturbance.fault,
                    .statistic = "time to the first sign",
                    .upper = Limit{.value = seconds_of(within_us)},
                    .unit = "s",
                    .stretch = Stretch{.window = {.from_us = onset_us, .to_us = onset_us + within_us}}}};
  if (auto why = not_measurable(evidence, disturbance); !why.empty())
    return {Outcome::not_measured, std::move(why), expected};
  const SignsOf signs = signs_of(evidence, disturbance, by);
  // A sign may name a cause that is valid before the onset: the sample was measured before the onset and sent
  // after the onset.
  const auto first = first_in(signs.fresh, disturbance.valid_from_us, evidence.truth.duration_us);
  const std::int64_t after_us = first ? std::max<std::int64_t>(first->t_us - onset_us, 0) : 0;
  const bool in_time = first && after_us <= within_us;
  if (!in_time && !signs.there_before.empty()) return {Outcome::not_measured, signs.why_hidden(), expected};
  if (!first) return {Outcome::fail, "no sign", expected};
  return {pass_if(in_time),
          fmt::format("after {:.3f} s: {}", seconds_of(after_us), first->text),
          expected,
          {.value = seconds_of(after_us), .worst_at_us = first->t_us}};
}

}  // namespace canhil::checks
