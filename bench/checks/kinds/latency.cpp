#include "bench/checks/kinds/latency.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/checks/answered.hpp"
#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/output_period.hpp"
#include "bench/checks/timing.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {

using scenario::Limits;

std::string read_answer(scenario::Section& section, const scenario::CheckContext& context) {
  const std::vector<std::string>& answers = context.contract.answers;
  std::string message =
      section.one_of({"message", "Name of a message that belongs to an answer."}, context.contract.messages);
  if (std::ranges::find(answers, message) == answers.end()) {
    section.reject("message", fmt::format("'{}' answers nothing", message),
                   answers.empty() ? std::string("one with 'answers' in the mapping, which has none")
                                   : fmt::format("one of: {}", fmt::join(answers, ", ")));
  }
  expect_sent(section, context, message);
  return message;
}

Latency Latency::read(scenario::Section& section, const scenario::CheckContext& context) {
  Latency rule;
  rule.message = read_answer(section, context);
  rule.window = scenario::read_window(section, context.duration_us);
  rule.below_us = section.time_us({"below_ms", "The quantile of the latencies must be below this value."},
                                  Limits::above(0));
  rule.quantile =
      section.number({"quantile", "Quantile of the latencies that is judged; 1: the largest latency."},
                     Limits::above(0, 1), 1);
  return rule;
}

Finding Latency::judge(const Evidence& evidence) const {
  const double bar_s = static_cast<double>(below_us) * 1e-6;
  const Expected expected{.text = fmt::format("{} {} < {:g} ms {}", message, quantile_name(quantile),
                                              bar_s * 1e3, seconds(window)),
                          .criterion = {.quantity = message,
                                        .statistic = quantile_name(quantile),
                                        .upper = exclusive(bar_s * 1e3),
                                        .unit = "ms",
                                        .stretch = Stretch{.window = window}}};
  if (!evidence.timing_unfit.empty()) return {Outcome::not_measured, evidence.timing_unfit, expected};
  const TimedWindow* timed = find_window(evidence.seen.timing, message, window);
  if (timed == nullptr) return {Outcome::not_measured, "no times were measured", expected};
  const Answered came = answered(evidence.seen, message, window);
  if (!came.half()) return too_few(evidence.seen, message, came, expected);
  if (auto why = unfit(evidence, quantile, bar_s); !why.empty())
    return {Outcome::not_measured, std::move(why), expected};
  if (timed->latency.count() == 0) return {Outcome::fail, "no answers", expected};
  const auto value = quantile_s(timed->latency, quantile, came.missing());
  if (!value) return too_few(evidence.seen, message, came, expected);
  return unless_host_disturbed(
      evidence, quantile, bar_s,
      {.nominal_s = nominal_period_s(evidence.seen, message),
       .count = timed->latency.count() + came.missing(),
       .missing = came.missing(),
       .outside = timed->latency.count_above(bar_s * 1e9),
       .bench_off = timed->lateness},
      {pass_if(*value < bar_s),
       fmt::format("{:.3f} ms of {}", *value * 1e3, timed->latency.count()),
       expected,
       {.value = *value * 1e3, .count = timed->latency.count(), .worst_at_us = timed->slowest_us}});
}

}  // namespace canhil::checks
