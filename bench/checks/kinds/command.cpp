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

// The time since the arrival of the newest command, at the start of each step of the plant [s]. The time
// before the first command counts from the begin of the window.
std::vector<double> ages(const CommandRecord& record, const scenario::Window& window) {
  std::vector<double> all;
  auto next = record.given.begin();
  std::int64_t newest_us = window.from_us;
  const std::int64_t first_us = (window.from_us + record.step_us - 1) / record.step_us * record.step_us;
  for (std::int64_t t_us = first_us; t_us <= window.to_us; t_us += record.step_us) {
    for (; next != record.given.end() && next->t_us <= t_us; ++next) newest_us = next->t_us;
    all.push_back(1e-6 * static_cast<double>(t_us - newest_us));
  }
  return all;
}

// From the time of validity of the measurement to the effect of the command that answers it [s].
std::vector<double> delays(const CommandRecord& record, const scenario::Window& window) {
  std::vector<double> all;
  for (const Given& one : record.given) {
    if (one.cause_us >= 0 && within(window, one.cause_us))
      all.push_back(1e-6 * static_cast<double>(one.t_us + record.delay_us - one.cause_us));
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
  const std::string expected = fmt::format("{} of the command '{}' {} < {:g} ms {}", is_age ? "age" : "delay",
                                           input, quantile_name(quantile), bar_s * 1e3, seconds(window));
  if (evidence.truth.plants.empty()) return {Outcome::not_measured, "the run has no plant", expected};
  const CommandRecord* record = nullptr;
  for (const world::PlantRecord* plant : evidence.truth.plants) {
    const auto found = std::ranges::find(plant->commands, input, &CommandRecord::input);
    if (found != plant->commands.end()) record = &*found;
  }
  if (record == nullptr || record->given.empty())
    return {Outcome::fail, fmt::format("no command of '{}' came", input), expected};
  const std::vector<double> times = is_age ? ages(*record, window) : delays(*record, window);
  if (times.empty() && is_age) return {Outcome::not_measured, "the plant has no step there", expected};
  if (times.empty()) return {Outcome::not_measured, "no command there answers a measurement", expected};
  const double value_s = checks::quantile(times, quantile);
  Finding finding{pass_if(value_s < bar_s), fmt::format("{:.3f} ms of {}", value_s * 1e3, times.size()),
                  expected};
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
