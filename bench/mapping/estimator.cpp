// A mapped target presented as an estimator of the bench: its tracks, samples, marks and result lines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "bench/checks/delay.hpp"
#include "bench/estimators/tracks.hpp"
#include "bench/mapping/answers.hpp"
#include "bench/quantities/unwrapped.hpp"

namespace canhil::mapping {
namespace {

using estimators::Truth;
using quantities::Track;
using quantities::TrackPoint;

const ReferenceQuantity& reference_of(const quantities::Quantity& quantity) {
  return *find_reference_quantity(quantity.name);
}

double difference(const ReferenceQuantity& of, double a, double b) {
  return of.turns ? std::remainder(a - b, 2 * std::numbers::pi) : a - b;
}

Spool<TrackPoint> errors_of(const ReferenceQuantity& of, const Spool<TimedValue>& all, const Truth& truth) {
  Spool<TrackPoint> errors;
  double last_truth = 0;
  for (const TimedValue& one : all) {
    const auto at = of.truth(truth, one.t_us);
    if (!at || one.t_us > truth.duration_us) continue;
    const double error = difference(of, one.value, *at);
    // The truth is unwrapped where it passes half a turn, the estimate to within half a turn of the truth.
    last_truth = of.turns ? quantities::unwrapped(*at, last_truth) : *at;
    errors.push_back({.t_us = one.t_us,
                      .value = error,
                      .sigma = one.sigma,
                      .estimate = last_truth + error,
                      .truth = last_truth});
  }
  return errors;
}

const Hear& hear_of(const Mapping& mapping, const quantities::Quantity* quantity) {
  return *std::ranges::find_if(mapping.hears, [&](const Hear& hear) {
    return std::ranges::any_of(hear.reported_signals, [&](const ReportedSignal& telling) {
      return !telling.sigma && telling.quantity->quantity == quantity;
    });
  });
}

// Why the causes of the answers with a quantity are not certain; empty: they are.
std::string ambiguous(const checks::Observations& seen, const quantities::Quantity& quantity) {
  const Mapping* mapping = seen.of<Answers>().mapping;
  return mapping == nullptr ? "" : seen.timing.answers[hear_of(*mapping, &quantity).of.index].ambiguous;
}

void tracks_of(const checks::Observations& seen, const Truth& truth, const quantities::TrackSink& give) {
  const Answers& answers = seen.of<Answers>();
  for (const auto& [quantity, all] : answers.values) {
    const ReferenceQuantity& of = reference_of(*quantity);
    const std::string_view message = hear_of(*answers.mapping, quantity).of.message->name;
    const estimators::Answering answering{.longest_wait_us = estimators::longest_wait_us(seen, message),
                                          .answers_end_us = truth.duration_us};
    Track track = answering.track(*quantity, std::string(quantity->meaning));
    track.estimate_title = std::string(quantity->name);
    track.estimate_unit = quantity->unit;
    track.points = errors_of(of, all, truth);
    if (!track.points.empty()) give(std::move(track));
  }
}

// Takes a sample at each time at which a quantity was reported. Each sample contains the last error of every
// quantity, because a target may report its quantities in turn. No sample is taken before every quantity has
// an error, and none if causes of answers are not certain.
quantities::Samples samples_of(const checks::Observations& seen, const Truth& truth) {
  const Answers& answers = seen.of<Answers>();
  if (answers.mapping == nullptr) return {};
  const Mapping& mapping = *answers.mapping;
  const bool unclear = std::ranges::any_of(
      mapping.quantities, [&](const auto* quantity) { return !ambiguous(seen, *quantity).empty(); });
  if (unclear) return {};
  std::map<std::int64_t, std::map<std::size_t, double>> by_time;  // by quantity
  for (std::size_t i = 0; i < mapping.quantities.size(); ++i) {
    const auto values = answers.values.find(mapping.quantities[i]);
    if (values == answers.values.end()) continue;
    for (const TrackPoint& one : errors_of(reference_of(*mapping.quantities[i]), values->second, truth))
      by_time[one.t_us][i] = one.value;
  }
  quantities::Samples samples(*mapping.layout);
  std::vector<std::optional<double>> last(mapping.quantities.size());
  for (const auto& [t_us, values] : by_time) {
    for (const auto& [index, value] : values) last[index] = value;
    if (std::ranges::any_of(last, [](const auto& value) { return !value; })) continue;
    std::vector<double> all;
    for (const auto& value : last) all.push_back(*value);
    samples.add(t_us, all);
  }
  return samples;
}

// The first mark is for all answers. It is followed by one mark for each message that answers a play or
// carries a quantity.
std::vector<estimators::Mark> marks_of(const checks::Observations& seen) {
  const Answers& answers = seen.of<Answers>();
  Answers::Times all;
  std::vector<estimators::Mark> marks;
  for (const auto& [message, times] : answers.messages) {
    const Hear& hear =
        *std::ranges::find(answers.mapping->hears, message,
                           [](const Hear& one) -> std::string_view { return one.of.message->name; });
    if (!hear.answers && hear.reported_signals.empty()) continue;
    for (const std::int64_t t_us : times) all.push_back(t_us);
    marks.push_back({.name = message, .t_us = times});
  }
  marks.insert(marks.begin(), {.name = "answers", .t_us = all});
  return marks;
}

std::vector<estimators::ResultLine> results_of(const checks::Observations& seen, const Truth& truth,
                                               std::string_view /*algorithm*/) {
  estimators::ResultLine end{.name = "final_error", .what = "error at the end"},
      delays{.name = "delay", .what = "delay against the truth"};
  tracks_of(seen, truth, [&](const Track& track) {
    const quantities::Quantity& quantity = *track.quantity;
    const std::string name(quantity.name);
    const double last = track.points.back().value;
    if (ambiguous(seen, quantity).empty())
      end.add(name, last,
              fmt::format("{} {:+.3f} {}", name, last / quantity.unit.factor, quantity.unit.name));
    else
      end.add(name, std::nullopt, fmt::format("{} not measured", name));
    const auto delay = checks::delay_of(track, {.from_us = 0, .to_us = truth.duration_us});
    delays.add(
        name, delay ? std::optional(delay->delay_s) : std::nullopt,
        delay ? fmt::format("{} {:.1f} +- {:.1f} ms", name, delay->delay_s * 1e3, delay->half_width_s * 1e3)
              : fmt::format("{} not measured ({})", name, delay.error().message));
  });
  return {std::move(end), std::move(delays)};
}

std::vector<std::string_view> closing_with(const checks::Observations& seen,
                                           const quantities::Quantity& quantity) {
  std::vector<std::string_view> messages;
  for (const Hear& hear : seen.of<Answers>().mapping->hears) {
    const bool has_it = std::ranges::any_of(hear.reported_signals, [&](const ReportedSignal& one) {
      return one.quantity->quantity == &quantity && !one.sigma;
    });
    if (hear.answers && has_it) messages.push_back(hear.of.message->name);
  }
  return messages;
}

std::string without_truth(const scenario::Scenario& scenario, const quantities::Quantity& quantity) {
  return why_no_truth(reference_of(quantity), scenario);
}

quantities::Freshness freshness_of(const scenario::Scenario& /*scenario*/) { return {}; }

}  // namespace

estimators::Estimator estimator_of(const Mapping& mapping) {
  return {.name = mapping.name,
          .facts = {.start = scenario::Start::nothing},
          .layout = *mapping.layout,
          .of_runs = mapping.quantities,
          .reception = nullptr,
          .samples = samples_of,
          .tracks = tracks_of,
          .marks = marks_of,
          .plain_marks = mapping.heard,
          .results = results_of,
          .why_no_truth = without_truth,
          .ambiguous = ambiguous,
          .closing = mapping.closing,
          .closing_with = closing_with,
          .freshness = freshness_of};
}

}  // namespace canhil::mapping
