#include "bench/scenario/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "bench/scenario/read_enum.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::scenario {
namespace {

constexpr std::array<std::string_view, 2> aligners{"transfer_alignment", "inflight_alignment"};
constexpr std::array<std::string_view, 3> attitude_axes{"roll", "pitch", "heading"};
constexpr std::array<std::string_view, 4> velocity_axes{"north", "east", "down", "norm"};
constexpr std::array<std::string_view, 5> position_axes{"north", "east", "down", "horizontal", "norm"};
constexpr std::array<std::string_view, 6> statistics{"attitude_nees", "nis",      "heading_nees",
                                                     "los_nis",       "wind_nis", "wind_nees"};
constexpr std::array<std::string_view, 4> wind_axes{"along_track", "cross_track", "down", "norm"};
constexpr std::array<std::string_view, 2> wind_statistics{"mean", "max"};
constexpr std::array<std::string_view, 3> los_planes{"pitch", "yaw", "both"};
constexpr std::array<std::string_view, 2> los_statistics{"rms", "max"};

/// What the readers of all kinds need to know of the scenario.
struct Context {
  std::int64_t duration_us;
  const Contract& contract;
  const Truths& truths;
};

/// Whose answers: to be said where two estimators align.
Aligner read_aligner(Section& section, const Context& context) {
  const std::vector<Aligner>& there = context.truths.aligners;
  if (there.size() > 1) return read_enum<Aligner>(section, "estimator", aligners);
  const Aligner only = there.empty() ? Aligner::transfer_alignment : there.front();
  const auto given = read_enum<Aligner>(section, "estimator", aligners, only);
  if (given != only)
    section.reject("estimator", fmt::format("'{}' is not run in this scenario", name(given)), name(only));
  return given;
}

/// An angle as STEM_mrad or STEM_deg.
std::pair<double, AngleUnit> read_angle(Section& section, const std::string& stem) {
  const bool in_degrees = section.has(stem + "_deg");
  if (!in_degrees) {
    section.optional(stem + "_deg");
    return {section.number(stem + "_mrad", Limits::above(0)), mrad};
  }
  if (section.has(stem + "_mrad")) {
    section.reject(stem + "_mrad", fmt::format("is given beside {}_deg", stem), "one of the two");
    section.optional(stem + "_mrad");
  }
  return {section.number(stem + "_deg", Limits::above(0)), degrees};
}

AttitudeError read(Section& section, const Context& context, AttitudeError rule) {
  rule.of = read_aligner(section, context);
  rule.axis = read_enum<AttitudeAxis>(section, "axis", attitude_axes);
  rule.window = read_window(section, context.duration_us);
  std::tie(rule.below, rule.unit) = read_angle(section, "below");
  return rule;
}

Convergence read(Section& section, const Context& context, Convergence rule) {
  rule.of = read_aligner(section, context);
  rule.axis = read_enum<AttitudeAxis>(section, "axis", attitude_axes);
  std::tie(rule.within, rule.unit) = read_angle(section, "within");
  rule.before_us = read_time(section, "before_s", Limits::above(0), context.duration_us);
  return rule;
}

VelocityError read(Section& section, const Context& context, VelocityError rule) {
  rule.of = read_aligner(section, context);
  rule.axis = read_enum<VelocityAxis>(section, "axis", velocity_axes, VelocityAxis::norm);
  rule.window = read_window(section, context.duration_us);
  rule.below = section.number("below_mps", Limits::above(0));
  return rule;
}

Consistency read(Section& section, const Context& context, Consistency rule) {
  rule.statistic = read_enum<Statistic>(section, "statistic", statistics);
  const bool of_alignment = rule.statistic == Statistic::nis || rule.statistic == Statistic::attitude_nees ||
                            rule.statistic == Statistic::heading_nees;
  if (of_alignment) rule.of = read_aligner(section, context);
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
  const bool white = rule.statistic == Statistic::nis || rule.statistic == Statistic::los_nis ||
                     rule.statistic == Statistic::wind_nis;
  if (!white)
    section.reject("probability", "is for nis, los_nis and wind_nis only", "mean_between = [low, high]");
  rule.bound = Probability{.value = section.number("probability", Limits::between(0.5, 0.999999))};
  section.optional("mean_between");
  return rule;
}

/// Nothing is there to be timed where nobody sends it.
void expect_sent(Section& section, const Context& context, const std::string& message) {
  const auto sender = context.contract.sent_by.find(message);
  if (sender == context.contract.sent_by.end()) return;
  const std::vector<std::string>& running = context.truths.estimators;
  if (std::ranges::find(running, sender->second) != running.end()) return;
  section.reject(
      "message",
      fmt::format("'{}' is sent by {}, which is not run in this scenario", message, sender->second),
      fmt::format("a message of {}", fmt::join(running, ", ")));
}

OutputPeriod read(Section& section, const Context& context, OutputPeriod rule) {
  rule.message = section.one_of("message", context.contract.messages);
  expect_sent(section, context, rule.message);
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
  expect_sent(section, context, rule.message);
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

BusErrorLimits read(Section& section, const Context& /*context*/, BusErrorLimits rule) {
  rule = {.bus_off_at_most = section.optional_integer("bus_off_at_most", 0).value_or(0),
          .down_at_most = section.optional_integer("down_at_most", 0).value_or(0),
          .passive_at_most = section.optional_integer("passive_at_most", 0),
          .warning_at_most = section.optional_integer("warning_at_most", 0),
          .error_frames_at_most = section.optional_integer("error_frames_at_most", 0),
          .late_in_queue_at_most = section.optional_integer("late_in_queue_at_most", 0)};
  return rule;
}

Heartbeat read(Section& section, const Context& /*context*/, Heartbeat rule) {
  rule.silent_at_most_us = section.time_us("silent_at_most_s", Limits::above(0));
  return rule;
}

PositionError read(Section& section, const Context& context, PositionError rule) {
  rule.axis = read_enum<PositionAxis>(section, "axis", position_axes, PositionAxis::norm);
  rule.window = read_window(section, context.duration_us);
  rule.below = section.number("below_m", Limits::above(0));
  return rule;
}

Fixes read(Section& section, const Context& context, Fixes rule) {
  rule.window = read_window(section, context.duration_us);
  for (const std::string& outcome : context.contract.fix_outcomes) {
    Fixes::Count count{.outcome = outcome,
                       .at_least = section.optional_integer(outcome + "_at_least", 0),
                       .at_most = section.optional_integer(outcome + "_at_most", 0)};
    expect_ordered(section, outcome + "_at_least", count.at_least, outcome + "_at_most", count.at_most);
    if (count.at_least || count.at_most) rule.counts.push_back(std::move(count));
  }
  rule.repairs_at_most = section.optional_integer("repairs_at_most", 0);
  rule.handed_over_before_us = section.optional_time_us("handed_over_before_s", Limits::above(0));
  if (rule.handed_over_before_us)
    expect_within_run(section, "handed_over_before_s", *rule.handed_over_before_us, context.duration_us);
  if (rule.counts.empty() && !rule.repairs_at_most && !rule.handed_over_before_us)
    section.reject("accepted_at_least", "is missing, as are all its like", "at least one limit");
  return rule;
}

Coasting read(Section& section, const Context& context, Coasting rule) {
  rule.window = read_window(section, context.duration_us);
  rule.at_least = section.optional_integer("at_least", 0);
  rule.at_most = section.optional_integer("at_most", 0);
  if (!rule.at_least && !rule.at_most)
    section.reject("at_least", "is missing, as is 'at_most'", "at least one limit");
  expect_ordered(section, "at_least", rule.at_least, "at_most", rule.at_most);
  return rule;
}

WindError read(Section& section, const Context& context, WindError rule) {
  rule.axis = read_enum<WindAxis>(section, "axis", wind_axes, WindAxis::norm);
  rule.statistic = read_enum<WindStatistic>(section, "statistic", wind_statistics, WindStatistic::max);
  rule.window = read_window(section, context.duration_us);
  rule.below = section.number("below_mps", Limits::above(0));
  return rule;
}

WindAnswers read(Section& section, const Context& context, WindAnswers rule) {
  rule.window = read_window(section, context.duration_us);
  const auto read_count = [&](const std::string& name, bool is_flag) {
    WindAnswers::Count count{.name = name,
                             .is_flag = is_flag,
                             .at_least = section.optional_integer(name + "_at_least", 0),
                             .at_most = section.optional_integer(name + "_at_most", 0)};
    expect_ordered(section, name + "_at_least", count.at_least, name + "_at_most", count.at_most);
    if (count.at_least || count.at_most) rule.counts.push_back(std::move(count));
  };
  for (const std::string& outcome : context.contract.wind_outcomes) read_count(outcome, false);
  for (const std::string_view flag : wind_flags) read_count(std::string(flag), true);
  if (rule.counts.empty())
    section.reject("updated_at_least", "is missing, as are all its like", "at least one limit");
  return rule;
}

LosRateError read(Section& section, const Context& /*context*/, LosRateError rule) {
  rule.plane = read_enum<LosPlane>(section, "plane", los_planes, LosPlane::both);
  rule.statistic = read_enum<LosStatistic>(section, "statistic", los_statistics, LosStatistic::rms);
  std::tie(rule.least_to_go, rule.most_to_go) = section.interval("time_to_go_s", Limits::at_least(0));
  rule.below = section.number("below_mradps", Limits::above(0));
  return rule;
}

MissDistance read(Section& section, const Context& /*context*/, MissDistance rule) {
  rule.below = section.number("below_m", Limits::above(0));
  return rule;
}

WireResponse read(Section& /*section*/, const Context& /*context*/, WireResponse rule) { return rule; }

BusLoad read(Section& section, const Context& /*context*/, BusLoad rule) {
  constexpr std::int64_t kilo = 1000;
  constexpr std::int64_t fastest = 1000, fastest_data = 8000;  // ISO 11898-2
  rule.bitrate = section.integer("bitrate_kbitps", 1) * kilo;
  if (rule.bitrate > fastest * kilo)
    section.reject("bitrate_kbitps", "is faster than CAN", fmt::format("kbit/s, at most {}", fastest));
  rule.data_bitrate = section.optional_integer("data_bitrate_kbitps", 1).value_or(0) * kilo;
  if (rule.data_bitrate != 0 &&
      (rule.data_bitrate < rule.bitrate || rule.data_bitrate > fastest_data * kilo)) {
    section.reject("data_bitrate_kbitps", fmt::format("is {}", rule.data_bitrate / kilo),
                   fmt::format("from bitrate_kbitps to {}", fastest_data));
  }
  rule.below = section.plain_number("below_percent", Limits::above(0, 100)) / 100;
  return rule;
}

using Rule = decltype(Check::rule);

/// What a rule holds answers against.
enum class Needs : std::uint8_t { nothing, navigation, engagement, glide };
template <class AnyRule>
constexpr Needs needs(const AnyRule& rule) {
  using R = std::remove_cvref_t<AnyRule>;
  if constexpr (std::is_same_v<R, Consistency>) {
    switch (rule.statistic) {
      case Statistic::nis:
      case Statistic::wind_nis:
        return Needs::nothing;
      case Statistic::los_nis:
        return Needs::engagement;
      case Statistic::wind_nees:
        return Needs::glide;
      case Statistic::attitude_nees:
      case Statistic::heading_nees:
        break;
    }
    return Needs::navigation;
  }
  if (std::is_same_v<R, LosRateError> || std::is_same_v<R, MissDistance>) return Needs::engagement;
  if (std::is_same_v<R, WindError>) return Needs::glide;
  const bool navigation = std::is_same_v<R, AttitudeError> || std::is_same_v<R, Convergence> ||
                          std::is_same_v<R, VelocityError> || std::is_same_v<R, PositionError>;
  return navigation ? Needs::navigation : Needs::nothing;
}

void expect_truth(Section& section, const Rule& rule, const Truths& truths) {
  const Needs needed = std::visit([](const auto& one) { return needs(one); }, rule);
  if (needed == Needs::navigation && !truths.navigation)
    section.reject("kind", "has nothing to be judged against", "a table [truth] in the scenario");
  if (needed == Needs::glide && !truths.glide)
    section.reject("kind", "has nothing to be judged against", "a table [glide] in the scenario");
  if (needed == Needs::engagement && !truths.engagement)
    section.reject("kind", "has nothing to be judged against", "a table [engagement] in the scenario");
}

/// What a rule looks at, if a scenario may well have several of its kind.
std::string subject(const AttitudeError& rule) { return fmt::format(" {}", name(rule.axis)); }
std::string subject(const Convergence& rule) { return fmt::format(" {}", name(rule.axis)); }
std::string subject(const VelocityError& rule) { return fmt::format(" {}", name(rule.axis)); }
std::string subject(const Consistency& rule) { return fmt::format(" {}", name(rule.statistic)); }
std::string subject(const OutputPeriod& rule) { return fmt::format(" {}", rule.message); }
std::string subject(const Latency& rule) { return fmt::format(" {}", rule.message); }
std::string subject(const Counters& /*rule*/) { return {}; }
std::string subject(const BusErrorLimits& /*rule*/) { return {}; }
std::string subject(const WireResponse& /*rule*/) { return {}; }
std::string subject(const Heartbeat& /*rule*/) { return {}; }
std::string subject(const PositionError& rule) { return fmt::format(" {}", name(rule.axis)); }
std::string subject(const Fixes& /*rule*/) { return {}; }
std::string subject(const Coasting& /*rule*/) { return {}; }
std::string subject(const WindError& rule) {
  return fmt::format(" {} {}", name(rule.axis), name(rule.statistic));
}
std::string subject(const WindAnswers& /*rule*/) { return {}; }
std::string subject(const LosRateError& rule) {
  return fmt::format(" {} {} to {:g} s to go", name(rule.plane), rule.most_to_go, rule.least_to_go);
}
std::string subject(const MissDistance& /*rule*/) { return {}; }
std::string subject(const BusLoad& rule) {
  const std::string data = rule.data_bitrate == 0 ? "" : fmt::format(" and {}", rule.data_bitrate / 1000);
  return fmt::format(" at {}{} kbit/s", rule.bitrate / 1000, data);
}

}  // namespace

std::string_view name(Aligner aligner) { return aligners[static_cast<std::size_t>(aligner)]; }
std::string_view name(AttitudeAxis axis) { return attitude_axes[static_cast<std::size_t>(axis)]; }
std::string_view name(VelocityAxis axis) { return velocity_axes[static_cast<std::size_t>(axis)]; }
std::string_view name(PositionAxis axis) { return position_axes[static_cast<std::size_t>(axis)]; }
std::string_view name(Statistic statistic) { return statistics[static_cast<std::size_t>(statistic)]; }

std::string_view name(WindAxis axis) { return wind_axes[static_cast<std::size_t>(axis)]; }
std::string_view name(WindStatistic statistic) {
  return wind_statistics[static_cast<std::size_t>(statistic)];
}
std::string_view name(LosPlane plane) { return los_planes[static_cast<std::size_t>(plane)]; }

std::string_view kind(const Check& check) { return kind_of(check.rule); }

Check read_check(Section& section, std::int64_t duration_us, const Contract& contract, const Truths& truths) {
  Check check;
  check.line = section.line();
  const std::string wanted = section.one_of("kind", kinds<Rule>());
  check.requirement = section.text("requirement", "");
  const Context context{.duration_us = duration_us, .contract = contract, .truths = truths};
  check.rule = read_rule<Rule>(wanted, [&](const auto& rule) { return read(section, context, rule); });
  expect_truth(section, check.rule, truths);
  const auto whose = [&](const auto& rule) -> std::string {
    if constexpr (requires { rule.of; }) {
      if (truths.aligners.size() > 1) return fmt::format(" of {}", name(rule.of));
    }
    return {};
  };
  const std::string by_default = std::visit(
      [&](const auto& rule) { return fmt::format("{}{}{}", rule.kind, subject(rule), whose(rule)); },
      check.rule);
  check.name = section.text("name", by_default);
  section.finish();
  return check;
}

}  // namespace canhil::scenario
