#include "bench/scenario/checks.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>

#include "bench/scenario/rule.hpp"

namespace canhil::scenario {
namespace {

constexpr std::array<std::string_view, 3> attitude_axes{"roll", "pitch", "heading"};
constexpr std::array<std::string_view, 4> velocity_axes{"north", "east", "down", "norm"};
constexpr std::array<std::string_view, 2> statistics{"attitude_nees", "nis"};

/// What the readers of all kinds need to know of the scenario.
struct Context {
  std::int64_t duration_us;
  const Contract& contract;
};

template <class Enum>
Enum read_enum(Section& section, std::string_view key, std::span<const std::string_view> names,
               std::optional<Enum> fallback = {}) {
  const std::vector<std::string> words(names.begin(), names.end());
  std::optional<std::string> word;
  if (fallback) word = words[static_cast<std::size_t>(*fallback)];
  const auto found = std::ranges::find(words, section.one_of(key, words, word));
  return found == words.end() ? Enum{} : static_cast<Enum>(found - words.begin());
}

AttitudeError read(Section& section, const Context& context, AttitudeError rule) {
  rule.axis = read_enum<AttitudeAxis>(section, "axis", attitude_axes);
  rule.window = read_window(section, context.duration_us);
  rule.below = section.number("below_mrad", Limits::above(0));
  return rule;
}

Convergence read(Section& section, const Context& context, Convergence rule) {
  rule.axis = read_enum<AttitudeAxis>(section, "axis", attitude_axes);
  rule.within = section.number("within_mrad", Limits::above(0));
  rule.before_us = read_time(section, "before_s", Limits::above(0), context.duration_us);
  return rule;
}

VelocityError read(Section& section, const Context& context, VelocityError rule) {
  rule.axis = read_enum<VelocityAxis>(section, "axis", velocity_axes, VelocityAxis::norm);
  rule.window = read_window(section, context.duration_us);
  rule.below = section.number("below_mps", Limits::above(0));
  return rule;
}

Consistency read(Section& section, const Context& context, Consistency rule) {
  rule.statistic = read_enum<Statistic>(section, "statistic", statistics);
  rule.window = read_window(section, context.duration_us);
  if (!section.has("probability")) {
    const auto [low, high] = section.interval("mean_between", Limits::at_least(0));
    rule.bound = MeanBetween{.low = low, .high = high};
    section.optional("probability");
    return rule;
  }
  if (section.has("mean_between"))
    section.reject("mean_between", "is given beside probability", "one of the two");
  // Errors of one run are correlated in time, so the mean of their NEES is not chi-square; innovations are
  // white.
  if (rule.statistic != Statistic::nis)
    section.reject("probability", "is for nis only", "mean_between = [low, high]");
  rule.bound = Probability{.value = section.number("probability", Limits::between(0.5, 0.999999))};
  section.optional("mean_between");
  return rule;
}

OutputPeriod read(Section& section, const Context& context, OutputPeriod rule) {
  rule.message = section.one_of("message", context.contract.messages);
  rule.window = read_window(section, context.duration_us);
  rule.within = section.number("within_percent", Limits::above(0));
  rule.quantile = section.number("quantile", Limits::above(0, 1), 1);
  return rule;
}

Latency read(Section& section, const Context& context, Latency rule) {
  const std::vector<std::string>& answers = context.contract.answers;
  rule.message = section.one_of("message", context.contract.messages);
  if (std::ranges::find(answers, rule.message) == answers.end()) {
    section.reject("message", fmt::format("'{}' answers nothing", rule.message),
                   fmt::format("one of: {}", fmt::join(answers, ", ")));
  }
  rule.window = read_window(section, context.duration_us);
  rule.below_us = section.time_us("below_ms", Limits::above(0));
  rule.quantile = section.number("quantile", Limits::above(0, 1), 1);
  return rule;
}

Counters read(Section& section, const Context& /*context*/, Counters rule) {
  rule = {.frames_lost_at_most = section.optional_integer("frames_lost_at_most", 0),
          .bad_crc_at_most = section.optional_integer("bad_crc_at_most", 0),
          .bad_group_at_most = section.optional_integer("bad_group_at_most", 0),
          .late_at_most = section.optional_integer("late_at_most", 0)};
  if (!rule.frames_lost_at_most && !rule.bad_crc_at_most && !rule.bad_group_at_most && !rule.late_at_most) {
    section.reject("frames_lost_at_most", "is missing, as are all its like", "at least one limit");
  }
  return rule;
}

Heartbeat read(Section& section, const Context& /*context*/, Heartbeat rule) {
  rule.silent_at_most_us = section.time_us("silent_at_most_s", Limits::above(0));
  return rule;
}

using Rule = decltype(Check::rule);

/// What a rule looks at, if a scenario may well have several of its kind.
std::string subject(const AttitudeError& rule) { return fmt::format(" {}", name(rule.axis)); }
std::string subject(const Convergence& rule) { return fmt::format(" {}", name(rule.axis)); }
std::string subject(const VelocityError& rule) { return fmt::format(" {}", name(rule.axis)); }
std::string subject(const Consistency& rule) { return fmt::format(" {}", name(rule.statistic)); }
std::string subject(const OutputPeriod& rule) { return fmt::format(" {}", rule.message); }
std::string subject(const Latency& rule) { return fmt::format(" {}", rule.message); }
std::string subject(const Counters& /*rule*/) { return {}; }
std::string subject(const Heartbeat& /*rule*/) { return {}; }

}  // namespace

std::string_view name(AttitudeAxis axis) { return attitude_axes[static_cast<std::size_t>(axis)]; }
std::string_view name(VelocityAxis axis) { return velocity_axes[static_cast<std::size_t>(axis)]; }
std::string_view name(Statistic statistic) { return statistics[static_cast<std::size_t>(statistic)]; }

std::string_view kind(const Check& check) { return kind_of(check.rule); }

Check read_check(Section& section, std::int64_t duration_us, const Contract& contract) {
  Check check;
  check.line = section.line();
  const std::string wanted = section.one_of("kind", kinds<Rule>());
  check.requirement = section.text("requirement", "");
  const Context context{.duration_us = duration_us, .contract = contract};
  check.rule = read_rule<Rule>(wanted, [&](const auto& rule) { return read(section, context, rule); });
  const std::string by_default = fmt::format(
      "{}{}", kind(check), std::visit([](const auto& rule) { return subject(rule); }, check.rule));
  check.name = section.text("name", by_default);
  section.finish();
  return check;
}

}  // namespace canhil::scenario
