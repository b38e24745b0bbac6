#include "bench/checks/kinds/of_tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <ranges>
#include <utility>

#include "bench/checks/condition.hpp"
#include "bench/checks/estimator.hpp"
#include "bench/checks/read_quantity.hpp"
#include "bench/checks/silence.hpp"
#include "bench/quantities/list.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::checks {
namespace {

using quantities::Quantity;
using quantities::Track;

bool runs(const scenario::CheckContext& context, std::string_view estimator) {
  return std::ranges::find(context.estimators, estimator) != context.estimators.end();
}

bool reports(const estimators::Estimator& estimator, const Quantity& quantity) {
  return std::ranges::find(estimator.of_runs, &quantity) != estimator.of_runs.end();
}

bool lies_in(const std::pair<double, double>& to_go_s, double value) {
  return value >= to_go_s.first && value < to_go_s.second;
}

// The unit that the section uses for the key. The name of the key is the stem, followed by the suffix of this
// unit.
quantities::Unit read_unit(scenario::Section& section, std::string_view stem, const Quantity& quantity) {
  if (quantity.unit.name != quantities::mrad.name) return quantity.unit;
  const std::string mrad = key_of(stem, quantities::mrad), degrees = key_of(stem, quantities::degrees);
  const bool in_degrees = section.has(degrees);
  if (in_degrees && section.has(mrad))
    section.reject(mrad, fmt::format("is given beside {}", degrees), "one of the two");
  section.optional(in_degrees ? mrad : degrees);
  return in_degrees ? quantities::degrees : quantities::mrad;
}

}  // namespace

std::string read_estimator(scenario::Section& section, const std::vector<std::string>& candidates,
                           std::string_view meaning, const scenario::CheckContext& context) {
  std::string name = section.given_name({"estimator", meaning}, candidates, "");
  if (!name.empty() || candidates.empty()) return name;
  if (context.each == nullptr || candidates.size() == 1) return candidates.front();
  context.each->number = candidates.size();
  context.each->estimator = candidates[context.each->index];
  return context.each->estimator;
}

Subject read_subject(scenario::Section& section, const scenario::CheckContext& context,
                     const std::function<bool(const Quantity&)>& wanted) {
  const auto reported_by = [&](const Quantity& quantity) {
    std::vector<std::string> names;
    for (const estimators::Estimator* one : context.contract.known) {
      if (runs(context, one->name) && reports(*one, quantity)) names.emplace_back(one->name);
    }
    return names;
  };
  const Quantity* quantity = read_quantity(
      section, estimators::quantities_of(context.contract.known), [&](const Quantity& one) -> std::string {
        if (!wanted(one)) return "cannot be used with this kind";
        return reported_by(one).empty() ? "is reported by no estimator of this scenario" : "";
      });
  const std::vector<std::string> names = reported_by(*quantity);
  constexpr std::string_view meaning =
      "Estimator to judge; it must report the quantity. By default, each estimator that reports the quantity "
      "is judged, by a check of its own.";
  Subject subject{.estimator = names.empty() ? "" : read_estimator(section, names, meaning, context),
                  .quantity = quantity,
                  .text = std::string(quantity->name)};
  if (names.size() > 1) subject.text += " of " + subject.estimator;
  return subject;
}

Stretch read_stretch(scenario::Section& section, const scenario::CheckContext& context,
                     const Subject& subject) {
  auto condition = Condition::read(section, context, subject.estimator);
  if (!section.has("time_to_go_s")) {
    section.optional("time_to_go_s");
    return {.window = scenario::read_window(section, context.duration_us), .condition = std::move(condition)};
  }
  if (subject.quantity != nullptr && !subject.quantity->has_time_to_go)
    section.reject("time_to_go_s", "is for flights that go to a target", "from_s and to_s");
  for (const std::string_view key : {"from_s", "to_s"})
    section.refuse(key, "has no effect beside time_to_go_s", "one of the two");
  return {.window = {.from_us = 0, .to_us = context.duration_us},
          .to_go_s = section.interval({"time_to_go_s",
                                       "Window of the time to go, in place of `from_s` and `to_s`; only for "
                                       "a missile that flies to a target."},
                                      scenario::Limits::at_least(0)),
          .condition = std::move(condition)};
}

std::pair<double, quantities::Unit> read_bar(scenario::Section& section, std::string_view stem,
                                             std::string_view meaning, const Quantity& quantity) {
  const quantities::Unit unit = read_unit(section, stem, quantity);
  return {
      section.number({key_of(stem, unit), meaning, fmt::format("{}_UNIT", stem)}, scenario::Limits::above(0)),
      unit};
}

std::pair<std::pair<double, double>, quantities::Unit> read_range(scenario::Section& section,
                                                                  std::string_view stem,
                                                                  std::string_view meaning,
                                                                  const Quantity& quantity) {
  const quantities::Unit unit = read_unit(section, stem, quantity);
  return {section.interval({key_of(stem, unit), meaning, fmt::format("{}_UNIT", stem)},
                           scenario::Limits::at_least(0)),
          unit};
}

std::vector<const Quantity*> parts_of(const Quantity& quantity) {
  if (quantity.parts.empty()) return {&quantity};
  return {quantity.parts.begin(), quantity.parts.end()};
}

int digits_of(const quantities::Unit& unit, double limit) {
  const int usual = unit.name == "m" ? 2 : unit.name == "m/s" ? 4 : 3;
  constexpr int most = 12;
  if (!(limit > 0)) return usual;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(limit / unit.factor))), usual, most);
}

std::string to_text(const Stretch& stretch) {
  const std::string part = stretch.to_go_s ? fmt::format("from {:g} to {:g} s to go", stretch.to_go_s->second,
                                                         stretch.to_go_s->first)
                                           : seconds(stretch.window);
  return stretch.condition == nullptr ? part : fmt::format("{} while {}", part, stretch.condition->text());
}

Places inside(const Track& track, const Stretch& stretch, const Evidence& evidence) {
  Places places;
  std::optional<Condition::InRun> condition;
  if (stretch.condition != nullptr) condition.emplace(*stretch.condition, evidence);
  auto epoch = track.to_go.begin();
  for (std::size_t index = 0; index < track.points.size(); ++index) {
    const std::int64_t t_us = track.points[index].t_us;
    if (stretch.to_go_s) {
      while (epoch != track.to_go.end() && epoch->t_us < t_us) ++epoch;
      if (epoch == track.to_go.end() || epoch->t_us != t_us || !lies_in(*stretch.to_go_s, epoch->to_go_s))
        continue;
    } else if (!within(stretch.window, t_us)) {
      continue;
    }
    if (condition && !condition->holds(t_us)) continue;
    places.push_back(index);
  }
  return places;
}

std::string silence(const Track& track, const Stretch& stretch, const Places& part) {
  if (stretch.to_go_s) {
    const auto flown = std::ranges::count_if(
        track.to_go, [&](const Track::ToGo& epoch) { return lies_in(*stretch.to_go_s, epoch.to_go_s); });
    if (flown == 0) return "the flight has no samples there";
    if (part.empty()) return "no answers";
    std::int64_t answered = 0;  // a sample that is answered twice counts once
    std::optional<std::int64_t> last_us;
    for (const std::size_t index : part) {
      const std::int64_t t_us = track.points[index].t_us;
      if (std::exchange(last_us, t_us) != t_us) ++answered;
    }
    if (static_cast<double>(answered) < least_answered * static_cast<double>(flown))
      return fmt::format("answers to {} of {} samples", answered, flown);
    return "";
  }
  Spool<std::int64_t> times;  // of the points, and of the answers at which the truth has no value
  auto without = track.without_truth.begin();
  const auto take_until = [&](std::int64_t t_us) {
    for (; without != track.without_truth.end() && *without <= t_us; ++without) {
      if (within(stretch.window, *without)) times.push_back(*without);
    }
  };
  for (const std::size_t index : part) {
    take_until(track.points[index].t_us);
    times.push_back(track.points[index].t_us);
  }
  take_until(stretch.window.to_us);
  if (times.empty()) return "no answers";
  if (track.unanswered) return track.unanswered(stretch.window.from_us, stretch.window.to_us);
  const auto silent = silent_stretch(times, stretch.window, track.answers_end_us, track.longest_wait_us);
  return silent ? "no answers " + seconds(*silent) : std::string();
}

namespace {

// Whether a window without answers is so short that it lies between two answers of a target that is not
// silent there: it is shorter than the mean time between all answers.
bool lies_between_answers(const Track& track, const scenario::Window& window) {
  constexpr std::int64_t never_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t first_us = never_us, last_us = 0, count = 0;
  scenario::Window around{.from_us = 0, .to_us = track.answers_end_us};
  const auto is_outside = [&](std::int64_t t_us) {
    first_us = std::min(first_us, t_us);
    last_us = std::max(last_us, t_us);
    ++count;
    if (t_us < window.from_us) around.from_us = std::max(around.from_us, t_us);
    if (t_us > window.to_us) around.to_us = std::min(around.to_us, t_us);
    return !within(window, t_us);
  };
  const bool none_inside = std::ranges::all_of(track.points, is_outside, &quantities::TrackPoint::t_us) &&
                           std::ranges::all_of(track.without_truth, is_outside);
  if (!none_inside || count < 2 || (window.to_us - window.from_us) * (count - 1) >= last_us - first_us)
    return false;
  if (track.unanswered) return track.unanswered(around.from_us, around.to_us).empty();
  return !silent_stretch(std::array<std::int64_t, 0>{}, around, track.answers_end_us, track.longest_wait_us);
}

}  // namespace

std::optional<Finding> no_evidence(const Track& track, const Stretch& stretch, const Places& part,
                                   const Expected& expected, const Evidence& evidence) {
  // The target must answer in the whole stretch, also while the condition does not hold.
  const Stretch whole{.window = stretch.window, .to_go_s = stretch.to_go_s};
  const Places all = stretch.condition == nullptr ? Places() : inside(track, whole, evidence);
  if (!stretch.to_go_s && part.empty() && all.empty() && lies_between_answers(track, stretch.window))
    return Finding{Outcome::not_measured, "the window is shorter than the time between two answers",
                   expected};
  if (std::string gap = silence(track, stretch, stretch.condition == nullptr ? part : all); !gap.empty())
    return Finding{Outcome::fail, std::move(gap), expected};
  if (!part.empty()) return std::nullopt;
  if (!all.empty()) return Finding{Outcome::not_measured, "the condition held at no answer", expected};
  return Finding{Outcome::not_measured, "the truth has no value there", expected};
}

}  // namespace canhil::checks
