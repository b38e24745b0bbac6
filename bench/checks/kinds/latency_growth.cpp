#include "bench/checks/kinds/latency_growth.hpp"

#include <fmt/format.h>

#include "bench/checks/answered.hpp"
#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/latency.hpp"
#include "bench/checks/timing.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {

using scenario::Limits;

LatencyGrowth LatencyGrowth::read(scenario::Section& section, const scenario::CheckContext& context) {
  LatencyGrowth rule;
  rule.message = read_answer(section, context);
  const scenario::Window window = scenario::read_window(section, context.duration_us);
  const std::int64_t third_us = (window.to_us - window.from_us) / 3;
  rule.first = {.from_us = window.from_us, .to_us = window.from_us + third_us};
  rule.last = {.from_us = window.to_us - third_us, .to_us = window.to_us};
  rule.ratio_below = section.number({"ratio_below",
                                     "The median latency of the last third of the window, divided by that of "
                                     "the first third, must be below this value."},
                                    Limits::above(1));
  return rule;
}

Finding LatencyGrowth::judge(const Evidence& evidence) const {
  constexpr double median = 0.5;
  Expected expected{
      .text = fmt::format("median latency of {} {} < {:g} times that {}", message, seconds(last), ratio_below,
                          seconds(first)),
      .criterion = {
          .quantity = message, .statistic = "median", .unit = "ms", .stretch = Stretch{.window = last}}};
  const TimedWindow* early = find_window(evidence.seen.timing, message, first);
  const TimedWindow* late = find_window(evidence.seen.timing, message, last);
  if (!evidence.timing_unfit.empty()) return {Outcome::not_measured, evidence.timing_unfit, expected};
  if (early == nullptr || late == nullptr) return {Outcome::not_measured, "no times were measured", expected};
  if (early->latency.count() == 0 || late->latency.count() == 0)
    return {Outcome::fail, "no answers", expected};
  const auto before = quantile_s(early->latency, median, answered(evidence.seen, message, first).missing());
  const auto after = quantile_s(late->latency, median, answered(evidence.seen, message, last).missing());
  if (!before || !after) {
    const scenario::Window& window = before ? last : first;
    Finding missing = too_few(evidence.seen, message, answered(evidence.seen, message, window), expected);
    missing.measured += " " + seconds(window);
    return missing;
  }
  const double before_s = *before, after_s = *after;
  expected.criterion.upper = exclusive(ratio_below * before_s * 1e3);
  Finding finding =
      unless_target_delayed(evidence, median, (ratio_below - 1) * before_s,
                            {pass_if(after_s < ratio_below * before_s),
                             fmt::format("{:.3f} ms of {}, before {:.3f} ms of {}", after_s * 1e3,
                                         late->latency.count(), before_s * 1e3, early->latency.count()),
                             expected,
                             {.value = after_s * 1e3, .count = late->latency.count()}});
  if (finding.outcome != Outcome::fail) return finding;
  // If the host slows down, both bench and target slow down. Only a target that fails needs this excuse.
  const double host_s = (late->lateness.quantile_ns(median) - early->lateness.quantile_ns(median)) * 1e-9;
  if (host_s > lateness_share * (ratio_below - 1) * before_s) {
    finding.outcome = Outcome::not_measured;
    finding.measured += fmt::format(
        "; this host delayed the bench itself more by {:.3f} ms (median), more than {:g} % of "
        "the allowed growth of the latency",
        host_s * 1e3, lateness_share * 100);
    return finding;
  }
  // The latency of a target on this host contains the time in which the host wakes it. This time changes, for
  // example when the target moves to another CPU, by no more than the bench's own wake-up takes.
  const double wake_s = late->lateness.quantile_ns(median) * 1e-9;
  const bool is_here = evidence.delays.waits.count() > 0;
  if (is_here && after_s - before_s < wake_s) {
    finding.outcome = Outcome::not_measured;
    finding.measured += fmt::format(
        "; it grew by less than this host takes to wake the bench itself, {:.3f} ms (median)", wake_s * 1e3);
  }
  return finding;
}

}  // namespace canhil::checks
