#include "bench/checks/kinds/recovers_within.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/of_tracks.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {

RecoversWithin RecoversWithin::read(scenario::Section& section, const scenario::CheckContext& context) {
  RecoversWithin rule;
  rule.disturbance = read_disturbance(section, context);
  if (!rule.disturbance.fault.empty() && rule.disturbance.window.to_us >= context.duration_us)
    section.reject("fault", fmt::format("'{}' lasts to the end of the run", rule.disturbance.fault),
                   "one that ends");
  rule.within_us = read_within(section, context, rule.disturbance.window.to_us,
                               "Longest permitted time from the end of the fault to the last sign.");
  rule.by = read_signs(section, context);
  section.optional("quantity");
  section.optional("estimator");
  if (section.has("quantity")) {
    rule.error = read_subject(section, context, [](const quantities::Quantity& quantity) {
      return quantity.degrees_of_freedom == 0 && !quantity.white && quantity.parts.empty();
    });
    std::tie(rule.below, rule.unit) = read_bar(section, "below",
                                               "|estimated - true| must be below this value at all times "
                                               "later than `within_s` after the end of the fault.",
                                               *rule.error->quantity);
  }
  for (const estimators::Estimator* one : running(context)) {
    const std::vector<Subject> reported = always_reported(*one);
    rule.answering.insert(rule.answering.end(), reported.begin(), reported.end());
  }
  return rule;
}

std::string RecoversWithin::subject() const {
  return fmt::format("{}{}{}", disturbance.fault, disturbance.fault.empty() || !error ? "" : " ",
                     error ? error->text : "");
}

std::vector<Subject> RecoversWithin::subjects() const {
  std::vector<Subject> all = answering;
  if (error) all.push_back(*error);
  return all;
}

std::vector<std::string> RecoversWithin::held_against_truth() const {
  return error ? std::vector{error->estimator} : std::vector<std::string>();
}

Stretch RecoversWithin::span() const {
  return {.window = {.from_us = disturbance.window.to_us + within_us,
                     .to_us = std::numeric_limits<std::int64_t>::max()}};
}

Finding RecoversWithin::judge(const Evidence& evidence) const {
  const auto seconds_of = [](std::int64_t t_us) { return static_cast<double>(t_us) * 1e-6; };
  Expected expected{
      .text = fmt::format("{} from {:g} s after the end of {} on",
                          by.empty() ? "no sign of it" : fmt::format("no {}", fmt::join(by, ", no ")),
                          seconds_of(within_us), disturbance.to_text()),
      .criterion = {.quantity = error ? std::string(error->quantity->name) : disturbance.fault,
                    .estimator = error ? error->estimator : "",
                    .statistic = "time to recover",
                    .upper = Limit{.value = seconds_of(within_us)},
                    .unit = "s",
                    .stretch = Stretch{.window = {.from_us = disturbance.window.to_us,
                                                  .to_us = evidence.truth.duration_us}}}};
  if (error) expected.text += fmt::format(", |{}| < {:g} {}", error->text, below / unit.factor, unit.name);
  const std::int64_t end_us = disturbance.window.to_us, due_us = end_us + within_us;
  const scenario::Window after{.from_us = due_us, .to_us = evidence.truth.duration_us};
  if (auto gap = silence_of(evidence, answering, after); !gap.empty())
    return {Outcome::fail, std::move(gap), expected};
  if (auto why = error ? did_not_strike(evidence, disturbance.fault) : not_measurable(evidence, disturbance);
      !why.empty())
    return {Outcome::not_measured, std::move(why), expected};
  const SignsOf signs = signs_of(evidence, disturbance, by);
  // A sign that the check names must end, even if it was present before.
  std::vector<Sign> ending = signs.fresh;
  if (!by.empty()) std::ranges::copy(signs.there_before, std::back_inserter(ending));
  bool holds = true;
  std::string measured = "no sign after its end";
  std::optional<std::int64_t> disturbed_us;  // time of the last sign, or of the last error beyond the limit
  const auto measurement = [&](std::optional<std::uint64_t> count = std::nullopt) -> Measurement {
    if (!disturbed_us) return {.count = count};
    return {.value = seconds_of(*disturbed_us - end_us), .count = count, .worst_at_us = disturbed_us};
  };
  if (const auto last = last_after(ending, end_us)) {
    holds = last->t_us <= due_us;
    disturbed_us = last->t_us;
    measured = fmt::format("last sign {:.3f} s after: {}", seconds_of(last->t_us - end_us), last->text);
  }
  // Without an error that is judged, only signs can show that there was something to recover from.
  if (!error && holds && !first_in(signs.fresh, disturbance.valid_from_us, after.to_us))
    return {Outcome::not_measured,
            signs.there_before.empty() ? "no sign at any time: there was nothing to recover from"
                                       : signs.why_hidden(),
            expected};
  if (!error) return {pass_if(holds), std::move(measured), std::move(expected), measurement()};
  const auto tracks = tracks_of(evidence, error->estimator, *error->quantity);
  if (tracks.empty()) return no_values(*error->quantity, expected);
  std::int64_t beyond_us = -1;  // time of the last error that is not below the limit; -1: none
  std::size_t judged = 0;
  for (const quantities::TrackPoint& point : tracks.front()->points) {
    if (point.t_us > due_us) ++judged;
    if (point.t_us > end_us && !(std::abs(point.value) < below)) beyond_us = point.t_us;
  }
  if (judged == 0) {
    const auto& untold = tracks.front()->without_truth;
    if (std::ranges::any_of(untold, [&](std::int64_t t_us) { return t_us > due_us; }))
      return {Outcome::not_measured, "the truth has no value there", expected};
    return {Outcome::fail, "no answers after that", expected};
  }
  measured += beyond_us < 0 ? ", always below"
                            : fmt::format(", below from {:.3f} s after", seconds_of(beyond_us - end_us));
  if (beyond_us >= 0) disturbed_us = std::max(disturbed_us.value_or(beyond_us), beyond_us);
  return {pass_if(holds && beyond_us <= due_us), std::move(measured), std::move(expected),
          measurement(judged)};
}

}  // namespace canhil::checks
