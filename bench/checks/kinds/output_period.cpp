#include "bench/checks/kinds/output_period.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/checks/answered.hpp"
#include "bench/checks/evidence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {

using scenario::Limits;

namespace {

// Why the bench sent too irregularly for a deviation of `bar_s`; empty: it did not. If the bench's own
// stimuli come too irregularly, irregular answers are not the target's fault.
std::string bench_off(const Evidence& evidence, const TimedWindow& timed, double quantile, double bar_s) {
  if (auto why = unfit(evidence, quantile, bar_s); !why.empty()) return why;
  const double off_s = timed.stimulus_deviation.quantile_ns(quantile) * 1e-9;
  if (off_s <= lateness_share * bar_s) return "";
  return fmt::format("the bench's own stimuli came {:.3f} ms off", off_s * 1e3);
}

}  // namespace

void expect_sent(scenario::Section& section, const scenario::CheckContext& context,
                 const std::string& message) {
  const auto sender = context.contract.sent_by.find(message);
  if (sender == context.contract.sent_by.end()) return;
  if (std::ranges::find(context.estimators, sender->second) != context.estimators.end()) return;
  section.reject(
      "message",
      fmt::format("'{}' is sent by {}, which is not run in this scenario", message, sender->second),
      fmt::format("a message of {}", fmt::join(context.estimators, ", ")));
}

OutputPeriod OutputPeriod::read(scenario::Section& section, const scenario::CheckContext& context) {
  OutputPeriod rule;
  rule.message =
      section.one_of({"message", "Name of a message that the target sends."}, context.contract.messages);
  expect_sent(section, context, rule.message);
  rule.window = scenario::read_window(section, context.duration_us);
  rule.within = section.number({"within_percent", "Largest permitted deviation, as a share of the period."},
                               Limits::above(0));
  rule.quantile =
      section.number({"quantile", "Quantile of the deviations that is judged; 1: the largest deviation."},
                     Limits::above(0, 1), 1);
  return rule;
}

Finding OutputPeriod::judge(const Evidence& evidence) const {
  const double nominal = nominal_period_s(evidence.seen, message);
  Expected expected{
      .text = fmt::format("{} every {:g} ms +- {:g} % ({}) {}", message, nominal * 1e3, within * 100,
                          quantile_name(quantile), seconds(window)),
      .criterion = {.quantity = message,
                    .statistic = fmt::format("deviation from the period, {}", quantile_name(quantile)),
                    .unit = "ms",
                    .stretch = Stretch{.window = window}}};
  if (nominal > 0) expected.criterion.upper = Limit{.value = nominal * within * 1e3};
  if (nominal <= 0) return {Outcome::not_measured, "the message has no period", expected};
  if (!evidence.timing_unfit.empty()) return {Outcome::not_measured, evidence.timing_unfit, expected};
  const TimedWindow* timed = find_window(evidence.seen.timing, message, window);
  if (timed == nullptr) return {Outcome::not_measured, "no times were measured", expected};
  if (auto why = bench_off(evidence, *timed, quantile, nominal * within); !why.empty()) {
    const Answered came = answered(evidence.seen, message, window);
    if (came.half()) return {Outcome::not_measured, std::move(why), expected};
    return too_few(evidence.seen, message, came, expected);
  }
  if (timed->period.count() == 0) return {Outcome::fail, "fewer than two arrivals", expected};
  const PeriodDeviation off =
      period_deviation(timed->period, nominal, began_after_s(evidence.seen, *timed),
                       ended_before_s(evidence.seen, *timed), quantile, nominal * within);
  // A message that is late counts twice: as missing in the gap before it, and as too early after that gap.
  return unless_host_disturbed(evidence, quantile, nominal * within,
                               {.nominal_s = nominal / 2,
                                .count = off.count,
                                .outside = off.outside,
                                .bench_off = timed->stimulus_deviation},
                               {pass_if(off.off_s <= nominal * within),
                                fmt::format("{:.3f} ms off, of {}", off.off_s * 1e3, off.count),
                                expected,
                                {.value = off.off_s * 1e3, .count = off.count}});
}

}  // namespace canhil::checks
