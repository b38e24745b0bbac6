// A mapped target presented as an estimator of the bench: its tracks, samples, marks and result lines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "bench/checks/delay.hpp"
#include "bench/estimators/end_of_flight.hpp"
#include "bench/estimators/tracks.hpp"
#include "bench/mapping/points.hpp"

namespace canhil::mapping {
namespace {

using estimators::Truth;
using quantities::Track;
using quantities::TrackPoint;

// A quantity with components has the truth of its components.
const ReferenceQuantity& reference_of(const MappedTarget& target, const quantities::Quantity& quantity) {
  const auto own =
      std::ranges::find(target.own, &quantity, [](const ReferenceQuantity& one) { return one.quantity; });
  if (own != target.own.end()) return *own;
  return *find_reference_quantity(quantity.parts.empty() ? quantity.name : quantity.parts.front()->name);
}

// The quantities that the target reports and from which a quantity comes: itself, or what it is derived from.
std::vector<const quantities::Quantity*> sources_of(const MappedTarget& target,
                                                    const quantities::Quantity& quantity) {
  if (!quantity.parts.empty()) return {quantity.parts.begin(), quantity.parts.end()};
  const ReferenceQuantity& of = reference_of(target, quantity);
  if (of.of.empty()) return {&quantity};
  return {of.of.begin(), of.of.end()};
}

// Why the causes of the answers with a quantity are not certain; empty: they are.
std::string ambiguous(const MappedTarget& target, const checks::Observations& seen,
                      const quantities::Quantity& quantity) {
  for (const quantities::Quantity* source : sources_of(target, quantity)) {
    std::string why = seen.timing.answers[hear_of(target, source).of.index].ambiguous;
    if (!why.empty()) return why;
  }
  return "";
}

Track::Kind kind_of(const quantities::Quantity& quantity) {
  if (quantity.degrees_of_freedom > 0) return Track::Kind::statistic;
  return quantity.white ? Track::Kind::innovation : Track::Kind::error;
}

void tracks_of(const MappedTarget& target, const checks::Observations& seen, const Truth& truth,
               const quantities::TrackSink& give) {
  for (const quantities::Quantity* quantity : target.quantities) {
    const ReferenceQuantity& of = reference_of(target, *quantity);
    const Hear& hear = hear_of(target, sources_of(target, *quantity).back());
    const estimators::Answering answering{
        .longest_wait_us = longest_wait_us(seen, hear),
        .answers_end_us = quantity->has_time_to_go
                              ? estimators::answers_end_us(truth.plants, truth.duration_us)
                              : truth.duration_us};
    Track track = answering.track(*quantity, std::string(quantity->meaning));
    track.kind = kind_of(*quantity);
    track.only_if_judged = !of.of.empty();
    Points points = points_of(of, target, seen, truth);
    track.points = std::move(points.points);
    track.without_truth = std::move(points.without_truth);
    if (track.kind == Track::Kind::error && of.of.empty()) {
      track.estimate_title = std::string(quantity->name);
      track.estimate_unit = quantity->unit;
    }
    if (!track.points.empty() || !track.without_truth.empty()) give(std::move(track));
  }
}

// Takes a sample at each time at which a quantity was reported. Each sample contains the last error of every
// quantity, because a target may report its quantities in turn. A NEES or a NIS is of one time only:
// elsewhere it is NaN, and where it cannot be computed, it is infinite. No sample is taken before every other
// quantity has an error, or after one was silent, and none if causes of answers are not certain.
quantities::Samples samples_of(const MappedTarget& target, const checks::Observations& seen,
                               const Truth& truth) {
  const auto& reported = target.layout->kept;
  const bool unclear = std::ranges::any_of(
      reported, [&](const auto* quantity) { return !ambiguous(target, seen, *quantity).empty(); });
  if (unclear) return {};
  constexpr double infinite = std::numeric_limits<double>::infinity();
  // By quantity; no value: the target reported it where it has no truth.
  std::map<std::int64_t, std::map<std::size_t, std::optional<double>>> by_time;
  for (std::size_t i = 0; i < reported.size(); ++i) {
    const Points points = points_of(reference_of(target, *reported[i]), target, seen, truth);
    for (const std::int64_t t_us : points.without_truth) by_time[t_us][i] = std::nullopt;
    for (const TrackPoint& one : points.points)
      by_time[one.t_us][i] = reported[i]->nan_allowed && std::isnan(one.value) ? infinite : one.value;
  }
  quantities::Samples samples(*target.layout);
  std::vector<std::optional<double>> last(reported.size());
  std::vector<std::int64_t> ends_us(reported.size());  // from when on the last value is too old
  std::vector<double> longest_us;
  for (const quantities::Quantity* quantity : reported) {
    longest_us.push_back(longest_wait_us(seen, hear_of(target, sources_of(target, *quantity).back())));
  }
  for (const auto& [t_us, values] : by_time) {
    for (std::size_t i = 0; i < last.size(); ++i) {
      // Innovations come with updates, which may be rare.
      if (t_us > ends_us[i] && !reported[i]->white) last[i].reset();
      if (reported[i]->nan_allowed) last[i] = std::nan("");
    }
    for (const auto& [index, value] : values) {
      if (value) last[index] = value;
      ends_us[index] = t_us + std::llround(longest_us[index]);
    }
    const bool any = std::ranges::any_of(values, [](const auto& one) { return one.second.has_value(); });
    if (!any || std::ranges::any_of(last, [](const auto& value) { return !value; })) continue;
    std::vector<double> all;
    for (const auto& value : last) all.push_back(*value);
    samples.add(t_us, all);
  }
  return samples;
}

// The first mark is for all answers. It is followed by one mark for each message that answers a play, or
// carries a quantity or a flag, and by the flags.
std::vector<estimators::Mark> marks_of(const MappedTarget& target, const checks::Observations& seen) {
  const Answers& answers = seen.of<Answers>();
  Answers::Times all;
  std::map<std::string_view, Answers::Times> by_message;
  for (const Hear& hear : target.hears) {
    if (!hear.answers && hear.reported_signals.empty() && hear.flags.empty()) continue;
    const std::string_view message = hear.of.message->name;
    const auto times = answers.messages.find(message);
    by_message[message] = times == answers.messages.end() ? Answers::Times{} : times->second;
  }
  std::vector<estimators::Mark> marks;
  for (const auto& [message, times] : by_message) {
    for (const std::int64_t t_us : times) all.push_back(t_us);
    marks.push_back({.name = message, .among = {}, .t_us = times});
  }
  for (const Hear& hear : target.hears) {
    for (const ReportedFlag& flag : hear.flags) {
      const auto set = answers.flags.find(&flag);
      marks.push_back({.name = flag.name,
                       .among = hear.of.message->name,
                       .t_us = set == answers.flags.end() ? Answers::Times{} : set->second});
    }
  }
  marks.insert(marks.begin(), {.name = "answers", .t_us = all});
  return marks;
}

std::vector<estimators::ResultLine> results_of(const MappedTarget& target, const checks::Observations& seen,
                                               const Truth& truth, std::string_view /*algorithm*/) {
  estimators::ResultLine end{.name = "final_error", .what = "error at the end"},
      delays{.name = "delay", .what = "delay against the truth"};
  tracks_of(target, seen, truth, [&](const Track& track) {
    const quantities::Quantity& quantity = *track.quantity;
    const ReferenceQuantity& of = reference_of(target, quantity);
    if (of.of.empty() && !of.has_truth()) return;
    if (track.points.empty() || track.kind != Track::Kind::error || of.of.size() > 1) return;
    const std::string name(quantity.name);
    const double last = track.points.back().value;
    // A position is shown in metres, which are derived from its coordinates. The last error of a LOS rate
    // says nothing, because the rate grows beyond all bounds at the passage.
    const bool is_derived = !of.of.empty();
    const bool shown = !quantity.has_time_to_go &&
                       is_derived == is_on_the_ground(is_derived ? reference_of(target, *of.of.front()) : of);
    const bool certain = ambiguous(target, seen, quantity).empty();
    if (shown && certain)
      end.add(name, last,
              fmt::format("{} {:+.3f} {}", name, last / quantity.unit.factor, quantity.unit.name));
    if (shown && !certain) end.add(name, std::nullopt, fmt::format("{} not measured", name));
    if (!of.of.empty()) return;
    const auto delay = checks::delay_of(track, {.from_us = 0, .to_us = truth.duration_us});
    delays.add(
        name, delay ? std::optional(delay->delay_s) : std::nullopt,
        delay ? fmt::format("{} {:.1f} +- {:.1f} ms", name, delay->delay_s * 1e3, delay->half_width_s * 1e3)
              : fmt::format("{} not measured ({})", name, delay.error().message));
  });
  std::vector<estimators::ResultLine> lines;
  if (const auto passage = estimators::Passage::find(truth.plants))
    lines.push_back(estimators::end_of_flight(*passage));
  if (lines.empty() || !end.figures.empty()) lines.push_back(std::move(end));
  lines.push_back(std::move(delays));
  return lines;
}

std::vector<std::string_view> closing_with(const MappedTarget& target, const quantities::Quantity& quantity) {
  std::vector<std::string_view> messages;
  for (const quantities::Quantity* source : sources_of(target, quantity)) {
    const Hear& hear = hear_of(target, source);
    const std::string_view name = hear.of.message->name;
    if (hear.is_owed() && std::ranges::find(messages, name) == messages.end()) messages.push_back(name);
  }
  return messages;
}

std::string without_truth(const MappedTarget& target, const scenario::Scenario& scenario,
                          const quantities::Quantity& quantity) {
  return why_no_truth(reference_of(target, quantity), scenario);
}

// Samples become stale if a message with a quantity is silent. If the period of one is not known, or if the
// truth of a quantity is an expression of the mapping, which may have no value at times, no sample does.
quantities::Freshness freshness_of(const MappedTarget& target, const scenario::Scenario& scenario) {
  if (!target.own.empty()) return {};
  const auto& mapping = dynamic_cast<const Mapping&>(*scenario.binding);
  double longest_us = 0;
  for (const Hear& hear : target.hears) {
    if (hear.reported_signals.empty()) continue;
    std::int64_t period_us = std::max(hear.task_us, hear.of.message->cycle_time_us);
    if (hear.is_owed()) period_us = std::max(period_us, mapping.plays[*hear.answers].period_us);
    if (period_us == 0) return {};
    longest_us =
        std::max(longest_us, pages_of(hear) * checks::longest_wait_us(static_cast<double>(period_us)));
  }
  return {.age_limit_us = std::llround(longest_us), .end_us = scenario.duration_us};
}

// A function of a mapped target as a function with a context.
template <auto function>
struct OfTarget;
template <class Returned, class... Arguments, Returned (*function)(const MappedTarget&, Arguments...)>
struct OfTarget<function> {
  static Returned call(const void* target, Arguments... arguments) {
    return function(*static_cast<const MappedTarget*>(target), arguments...);
  }
};

}  // namespace

estimators::Estimator estimator_of(const MappedTarget& target) {
  return {.name = target.name,
          .facts = {.start = scenario::Start::nothing},
          .layout = *target.layout,
          .of_runs = target.of_runs,
          .reception = nullptr,
          .samples = {OfTarget<samples_of>::call, &target},
          .tracks = {OfTarget<tracks_of>::call, &target},
          .marks = {OfTarget<marks_of>::call, &target},
          .plain_marks = target.plain_marks,
          .results = {OfTarget<results_of>::call, &target},
          .why_no_truth = {OfTarget<without_truth>::call, &target},
          .ambiguous = {OfTarget<ambiguous>::call, &target},
          .closing = target.closing,
          .closing_with = {OfTarget<closing_with>::call, &target},
          .freshness = {OfTarget<freshness_of>::call, &target}};
}

}  // namespace canhil::mapping
