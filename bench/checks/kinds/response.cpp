#include "bench/checks/kinds/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "bench/checks/evidence.hpp"
#include "bench/scenario/quantity.hpp"
#include "bench/scenario/rule.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/plant_record.hpp"
#include "bench/world/truth_values.hpp"

namespace canhil::checks {
namespace {

using scenario::Limits;

constexpr std::array<std::string_view, 3> response_statistics{"settling_time", "overshoot", "steady_error"};

// The values that can be followed, with their SI units.
std::vector<scenario::PlantFacts::Output> followed(const scenario::CheckContext& context) {
  std::vector<scenario::PlantFacts::Output> all(context.plant.outputs);
  for (const world::TruthValue& one : world::truth_values())
    all.push_back({.name = std::string(one.name), .si = std::string(one.si), .turns = one.turns});
  return all;
}

// A target that waited for a CPU is not blamed, but may pass. In a loop that was late, nothing is measured.
Finding unless_host_late(const Evidence& evidence, Finding finding) {
  if (std::string late = late_loop(evidence); !late.empty())
    return {Outcome::not_measured, finding.measured + "; " + late, finding.expected, finding.measurement};
  if (evidence.timing_unfit == virtual_time) return finding;
  constexpr double usual = 0.99;  // quantile
  const world::PlantRecord* plant = world::steered(evidence.truth.plants);
  if (plant == nullptr) return finding;
  const double step_s = 1e-6 * static_cast<double>(plant->commands.front().step_us);
  return unless_target_delayed(evidence, usual, step_s / lateness_share, std::move(finding));
}

// When the motion of the plant with this value came to its own end: nothing follows it after that.
std::int64_t end_of(const world::PlantRecords& plants, std::string_view value) {
  for (const world::PlantRecord* plant : plants) {
    if (plant->ended_us && plant->find(value)) return *plant->ended_us;
  }
  return std::numeric_limits<std::int64_t>::max();
}

// Without a command, the plant only coasts.
std::string missing_command(const Evidence& evidence, const scenario::Window& window) {
  for (const world::PlantRecord* plant : evidence.truth.plants) {
    for (const world::CommandRecord& one : plant->commands) {
      if (one.given.empty() || one.given.front().t_us > window.to_us)
        return fmt::format("no command of '{}' came", one.input);
    }
  }
  return "";
}

}  // namespace

Response Response::read(scenario::Section& section, const scenario::CheckContext& context) {
  Response rule;
  const auto known = followed(context);
  std::vector<std::string> names;
  for (const auto& one : known) names.push_back(one.name);
  const std::string name =
      section.given_name({"quantity", "True value: one of the bench, or an output of the plant."}, names);
  const auto found = std::ranges::find(known, name, &scenario::PlantFacts::Output::name);
  if (found != known.end()) {
    rule.value = world::find_truth_value(name);
    rule.turns = found->turns;
    rule.ending = scenario::ending_for(found->si);
  }
  const std::string word =
      section.one_of({"statistic", "What is judged."},
                     std::vector<std::string>(response_statistics.begin(), response_statistics.end()));
  rule.statistic =
      static_cast<Statistic>(std::ranges::find(response_statistics, word) - response_statistics.begin());
  const std::string ending(rule.ending);
  rule.setpoint = section.number(
      {"setpoint" + ending, "The value that the loop should reach.", "setpoint_UNIT"}, Limits{});
  const bool settles = rule.statistic == Statistic::settling_time;
  if (settles) {
    rule.band = section.number(
        {"band" + ending, "Only with `settling_time`: largest deviation of a settled value.", "band_UNIT"},
        Limits::above(0));
    rule.below = section.number(
        {"below_s", "Only with `settling_time`: time from `from_s` within which the value is settled."},
        Limits::above(0));
  } else {
    section.refuse("band" + ending, "has no effect", "statistic = \"settling_time\" beside it");
    rule.below = section.number(
        {"below" + ending, "Limit of the overshoot, or of the largest error in the window.", "below_UNIT"},
        Limits::above(0));
  }
  rule.window = scenario::read_window(section, context.duration_us);
  return rule;
}

std::string Response::subject() const {
  const std::string_view word = response_statistics[static_cast<std::size_t>(statistic)];
  return fmt::format("{} of {}", word, value == nullptr ? "" : value->name);
}

std::string Response::shown(double in_si) const {
  if (ending.empty()) return fmt::format("{:.4g}", in_si);
  return fmt::format("{:.4g} {}", in_si / scenario::factor_of(ending), scenario::unit_of(ending));
}

Finding Response::judge(const Evidence& evidence) const {
  const bool settles = statistic == Statistic::settling_time;
  Expected expected;
  expected.text = settles ? fmt::format("within {} of {} in less than {:g} s {}", shown(band),
                                        shown(setpoint), below, seconds(window))
                          : fmt::format("{} < {} at {} {}",
                                        statistic == Statistic::overshoot ? "overshoot" : "steady error",
                                        shown(below), shown(setpoint), seconds(window));
  const double factor = settles || ending.empty() ? 1 : scenario::factor_of(ending);
  expected.criterion = {.quantity = std::string(value->name),
                        .statistic = std::string(response_statistics[static_cast<std::size_t>(statistic)]),
                        .upper = exclusive(below / factor),
                        .unit = std::string(settles          ? "s"
                                            : ending.empty() ? ""
                                                             : scenario::unit_of(ending)),
                        .stretch = Stretch{.window = window}};
  if (!evidence.ended_early.empty()) return {Outcome::not_measured, "the run ended early", expected};
  if (std::string missing = missing_command(evidence, window); !missing.empty())
    return {Outcome::fail, std::move(missing), expected};
  const world::Truths truths = estimators::truths_of(evidence.truth);
  std::optional<double> first, last, largest, beyond;
  std::int64_t largest_at_us = window.from_us, beyond_at_us = window.from_us;
  std::uint64_t count = 0;
  std::int64_t outside_us = -1;
  const std::int64_t step_us = evidence.truth.flight.interval_us();
  std::int64_t last_us = window.from_us;
  const std::int64_t end_us = std::min(window.to_us, end_of(evidence.truth.plants, value->name));
  for (std::int64_t t_us = window.from_us; t_us <= end_us; t_us += step_us) {
    const auto at = value->at(truths, t_us);
    if (!at && evidence.truth.flight.grows() && t_us > evidence.truth.flight.known_until_us()) break;
    if (!at)
      return {Outcome::not_measured,
              fmt::format("the truth has no {} at {:g} s", value->name, 1e-6 * static_cast<double>(t_us)),
              expected};
    const double off = turns ? std::remainder(*at - setpoint, 2 * std::numbers::pi) : *at - setpoint;
    if (!first) first = off;
    if (!(std::abs(off) <= band)) outside_us = t_us;
    last = off;
    if (!largest || std::abs(off) > *largest) largest_at_us = t_us;
    largest = std::max(largest.value_or(0), std::abs(off));
    const double off_beyond = *first > 0 ? -off : off;
    if (off_beyond > beyond.value_or(0)) beyond_at_us = t_us;
    beyond = std::max(beyond.value_or(0), off_beyond);
    last_us = t_us;
    ++count;
  }
  const auto found = [&](bool good, std::string measured, std::optional<double> figure,
                         std::int64_t worst_at_us) {
    if (figure) *figure /= factor;
    return unless_host_late(evidence, {pass_if(good),
                                       std::move(measured),
                                       expected,
                                       {.value = figure, .count = count, .worst_at_us = worst_at_us}});
  };
  if (statistic == Statistic::steady_error)
    return found(*largest < below, "max " + shown(*largest), largest, largest_at_us);
  // The rounding of a setpoint in another unit is no step.
  const double no_step = 1e-9 * std::max({1.0, std::abs(setpoint), *largest});
  if (statistic == Statistic::overshoot && !(std::abs(*first) > no_step))
    return {Outcome::not_measured, "the response begins at its setpoint", expected};
  // A turn by more than half a circle has no side beyond the setpoint.
  if (statistic == Statistic::overshoot)
    return found(*beyond < below,
                 fmt::format("{}, {:.1f} % of the step", shown(*beyond), 100 * *beyond / std::abs(*first)),
                 beyond, beyond_at_us);
  if (outside_us < 0) return {Outcome::not_measured, "the response begins in the band", expected};
  if (outside_us == last_us)
    return found(false, fmt::format("not settled: {} off at the end", shown(std::abs(*last))), std::nullopt,
                 outside_us);
  const double settled_s = 1e-6 * static_cast<double>(outside_us + step_us - window.from_us);
  return found(settled_s < below, fmt::format("settled after {:.3g} s", settled_s), settled_s, outside_us);
}

}  // namespace canhil::checks
