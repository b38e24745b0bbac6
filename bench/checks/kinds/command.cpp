#include "bench/checks/kinds/command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/checks/evidence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/scenario/rule.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::checks {
namespace {

using scenario::Limits;
using world::CommandRecord;
using world::Given;

struct Durations {
  std::vector<double> s{};
  std::int64_t longest_at_us = 0;
  void add(std::int64_t at_us, std::int64_t duration_us) {
    const double duration_s = 1e-6 * static_cast<double>(duration_us);
    if (s.empty() || duration_s > longest_s_) {
      longest_s_ = duration_s;
      longest_at_us = at_us;
    }
    s.push_back(duration_s);
  }

 private:
  double longest_s_ = 0;
};

// The time since the arrival of the newest command, at the start of each step of the plant. The time before
// the first command counts from the begin of the window.
Durations ages(const CommandRecord& record, const scenario::Window& window) {
  Durations all;
  auto next = record.given.begin();
  std::int64_t newest_us = window.from_us;
  const std::int64_t first_us = (window.from_us + record.step_us - 1) / record.step_us * record.step_us;
  for (std::int64_t t_us = first_us; t_us <= window.to_us; t_us += record.step_us) {
    for (; next != record.given.end() && next->t_us <= t_us; ++next) newest_us = next->t_us;
    all.add(t_us, t_us - newest_us);
  }
  return all;
}

// From the time of validity of the measurement to the effect of the command that answers it.
Durations delays(const CommandRecord& record, const scenario::Window& window) {
  Durations all;
  for (const Given& one : record.given) {
    if (one.cause_us >= 0 && within(window, one.cause_us))
      all.add(one.cause_us, one.t_us + record.delay_us - one.cause_us);
  }
  return all;
}

}  // namespace

CommandTime CommandTime::read(scenario::Section& section, const scenario::CheckContext& context) {
  CommandTime rule;
  rule.input =
      section.given_name({"command", "Input of the plant that the target commands."}, context.plant.steered);
  const std::vector<std::string> names{"age", "delay"};
  rule.statistic =
      section.one_of({"statistic", "What is judged."}, names) == "age" ? Statistic::age : Statistic::delay;
  rule.below_us =
      section.time_us({"below_ms", "The quantile of the times must be below this value."}, Limits::above(0));
  rule.quantile = section.number({"quantile", "Quantile of the times that is judged; 1: the longest time."},
                                 Limits::above(0, 1), 1);
  rule.window = scenario::read_window(section, context.duration_us);
  return rule;
}

std::string CommandTime::subject() const {
  return fmt::format("{} of {}", statistic == Statistic::age ? "age" : "delay", input);
}

Finding CommandTime::judge(const Evidence& evidence) const {
  const bool is_age = statistic == Statistic::age;
  const double bar_s = 1e-6 * static_cast<double>(below_us);
  const Expected expected{
      .text = fmt::format("{} of the command '{}' {} < {:g} ms {}", is_age ? "age" : "delay", input,
                          quantile_name(quantile), bar_s * 1e3, seconds(window)),
      .criterion = {.quantity = input,
                    .statistic = quantile_name(quantile),
                    .upper = exclusive(bar_s * 1e3),
                    .unit = "ms",
                    .stretch = Stretch{.window = window}}};
  if (evidence.truth.plants.empty()) return {Outcome::not_measured, "the run has no plant", expected};
  const CommandRecord* record = nullptr;
  for (const world::PlantRecord* plant : evidence.truth.plants) {
    const auto found = std::ranges::find(plant->commands, input, &CommandRecord::input);
    if (found != plant->commands.end()) record = &*found;
  }
  if (record == nullptr || record->given.empty())
    return {Outcome::fail, fmt::format("no command of '{}' came", input), expected};
  const Durations times = is_age ? ages(*record, window) : delays(*record, window);
  if (times.s.empty() && is_age) return {Outcome::not_measured, "the plant has no step there", expected};
  if (times.s.empty()) return {Outcome::not_measured, "no command there answers a measurement", expected};
  const double value_s = checks::quantile(times.s, quantile);
  Finding finding{pass_if(value_s < bar_s),
                  fmt::format("{:.3f} ms of {}", value_s * 1e3, times.s.size()),
                  expected,
                  {.value = value_s * 1e3, .count = times.s.size(), .worst_at_us = times.longest_at_us}};
  if (evidence.timing_unfit == virtual_time) {
    // An answer takes no virtual time, so that its delay is at least this.
    if (is_age || finding.outcome == Outcome::fail) return finding;
    return {Outcome::not_measured, finding.measured + " or more: virtual time", expected};
  }
  if (auto why = unfit(evidence, quantile, bar_s); !why.empty())
    return {Outcome::not_measured, std::move(why), expected};
  return unless_target_delayed(evidence, quantile, bar_s, std::move(finding));
}

}  // namespace canhil::checks
