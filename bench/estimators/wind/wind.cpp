#include "bench/estimators/wind/wind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bench/estimators/freshness.hpp"
#include "bench/estimators/marks.hpp"
#include "bench/estimators/names.hpp"
#include "bench/estimators/of_scenario.hpp"
#include "bench/estimators/tracks.hpp"
#include "bench/estimators/trust.hpp"
#include "bench/estimators/wind/answers.hpp"
#include "bench/estimators/wind/quantities.hpp"
#include "bench/scenario/scenario.hpp"
#include "messages/canhil.hpp"

namespace canhil::estimators {
namespace {

using namespace quantities;

constexpr std::array<const Quantity*, 8> kept{&wind_along, &wind_cross,       &wind_down,        &wind_nis,
                                              &wind_nees,  &wind_along_sigma, &error_over_sigma, &degraded};

double of_all_three(const Samples& samples, std::size_t index) {
  return std::hypot(samples.value(index, wind_along), samples.value(index, wind_cross),
                    samples.value(index, wind_down));
}
double along_over_its_sigma(const Samples& samples, std::size_t index) {
  return samples.value(index, wind_along) / samples.value(index, wind_along_sigma);
}
constexpr std::array derived{Derived{.quantity = &wind_norm, .of = of_all_three},
                             Derived{.quantity = &wind_along_over_sigma, .of = along_over_its_sigma},
                             derived_trust};

constexpr std::array<const Quantity*, 10> of_runs{&wind_north, &wind_east, &wind_down,  &wind_along,
                                                  &wind_cross, &wind_norm, &wind_speed, &wind_from,
                                                  &wind_nis,   &wind_nees};

constexpr Layout layout{.kept = kept, .derived = derived};

Samples samples_of(const checks::Observations& seen, const Truth& truth) {
  Samples samples(layout);
  const auto air = TrueAir::find(truth.plants, true_air);
  if (!air) return samples;
  const auto errors = wind_errors(seen.of<WindAnswers>(), *air);
  const auto normalised = nees_of(seen.of<WindAnswers>(), *air);  // one for each error
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const WindAnswer& answer = seen.of<WindAnswers>()[errors[i].answer];
    const bool updated = answer.outcome == messages::WindOutcome::updated;
    const std::array<double, kept.size()> values{
        errors[i].along_track,
        errors[i].cross_track,
        errors[i].error_n.z(),
        updated ? infinite_if_nan(answer.nis) : std::numeric_limits<double>::quiet_NaN(),
        infinite_if_nan(normalised[i].value),
        answer.along_track_sigma,
        over_sigma(errors[i].error_n, answer.sigma),
        answer.degraded ? 1.0 : 0.0};
    samples.add(errors[i].t_us, values);
  }
  return samples;
}

void tracks_of(const checks::Observations& seen, const Truth& truth, const TrackSink& give) {
  const auto air = TrueAir::find(truth.plants, true_air);
  if (!air) return;
  const WindAnswers& answers = seen.of<WindAnswers>();
  const auto errors = wind_errors(answers, *air);
  const Answering of{longest_wait_us(seen, messages::WindUpdate::info.name), truth.duration_us};
  const auto fill = [&](Track track, auto point_of) {
    for (const WindError& e : errors) {
      track.points.push_back(point_of(answers[e.answer], e));
      track.points.back().t_us = e.t_us;
    }
    give(std::move(track));
  };
  each_axis({&wind_north, &wind_east, &wind_down},
            [&](const Quantity& quantity, const std::string& name, int axis) {
              Track track = of.track(quantity, "wind error " + name);
              track.estimate_title = "wind " + name;
              track.estimate_unit = mps;
              fill(std::move(track), [=](const WindAnswer& answer, const WindError& e) {
                const double estimate = answer.wind_n(axis);
                return TrackPoint{.value = e.error_n(axis),
                                  .sigma = answer.sigma(axis),
                                  .estimate = estimate,
                                  .truth = estimate - e.error_n(axis)};
              });
            });
  fill(judged(of.track(wind_along, "wind error along track")), [](const auto& answer, const WindError& e) {
    return TrackPoint{.value = e.along_track, .sigma = answer.along_track_sigma};
  });
  fill(judged(of.track(wind_cross, "wind error cross track")), [](const auto& answer, const WindError& e) {
    return TrackPoint{.value = e.cross_track, .sigma = answer.cross_track_sigma};
  });
  fill(judged(of.track(wind_speed, "wind speed error")), [](const auto& answer, const WindError& e) {
    return TrackPoint{.value = e.speed, .sigma = answer.speed_sigma};
  });
  fill(judged(of.track(wind_from, "wind direction error")), [](const auto& answer, const WindError& e) {
    return TrackPoint{.value = e.from, .sigma = answer.from_sigma};
  });
  fill(judged(of.track(wind_norm, "wind error norm")),
       [](const auto&, const WindError& e) { return TrackPoint{.value = e.error_n.norm()}; });
  give(of.statistic(wind_nis, "normalised innovation squared", nis_of(answers)));
  give(judged(of.statistic(wind_nees, "normalised error squared", nees_of(answers, *air))));
}

std::vector<Mark> marks_of(const checks::Observations& seen) {
  const WindAnswers& answers = seen.of<WindAnswers>();
  std::vector<Mark> marks{{.name = "answers", .t_us = times_of(answers, every_answer)}};
  add_marks(marks, answers, &WindAnswer::outcome, messages::enumerators<messages::WindOutcome>);
  for (const auto& [name, flag] :
       {std::pair{"outside", &WindAnswer::outside}, std::pair{"fins_late", &WindAnswer::fins_late},
        std::pair{"fins_missing", &WindAnswer::fins_missing},
        std::pair{"fins_not_physical", &WindAnswer::fins_not_physical},
        std::pair{"theta_capped", &WindAnswer::theta_capped}, std::pair{"degraded", &WindAnswer::degraded}})
    marks.push_back({.name = name, .t_us = times_of(answers, flag)});
  return marks;
}

std::vector<ResultLine> results_of(const checks::Observations& seen, const Truth& truth,
                                   std::string_view /*algorithm*/) {
  const auto air = TrueAir::find(truth.plants, true_air);
  if (!air) return {};
  constexpr std::int64_t from_us = 10'000'000;  // until then the filter settles
  Spool<WindError> errors;
  for (const WindError& error : wind_errors(seen.of<WindAnswers>(), *air)) {
    if (error.t_us >= from_us) errors.push_back(error);
  }
  ResultLine mean{.name = "mean_error", .what = "mean |error| from 10 s on"};
  const auto add = [&](const char* name, const char* words, auto component) {
    double sum = 0;
    for (const WindError& error : errors) sum += std::abs(component(error));
    if (errors.empty()) {
      mean.add(name, std::nullopt, std::string(words) + " none judged");
    } else {
      const double value = sum / static_cast<double>(errors.size());
      mean.add(name, value, fmt::format("{} {:.3f} m/s", words, value));
    }
  };
  add("norm", "of the vector", [](const WindError& error) { return error.error_n.norm(); });
  add("along_track", "along track", [](const WindError& error) { return error.along_track; });
  add("cross_track", "across", [](const WindError& error) { return error.cross_track; });
  add("down", "down", [](const WindError& error) { return error.error_n.z(); });
  ResultLine at_end{.name = "told", .what = "reported at the end"};
  if (!seen.of<WindAnswers>().empty()) {
    const double sigma = seen.of<WindAnswers>().back().along_track_sigma;
    at_end.add("along_track_sigma", sigma, fmt::format("sigma along track {:.3f} m/s", sigma));
  }
  return {std::move(mean), std::move(at_end)};
}

constexpr std::array closing{messages::WindUpdate::info.name};

// The filter may answer less often than it receives navigation groups.
Freshness freshness_of(const scenario::Scenario& scenario) {
  const scenario::NodeSettings* navigation = scenario.node("glider_nav");
  if (navigation == nullptr) return {};
  double answers_us = period_us(*navigation);
  answers_us = std::max(answers_us, output_interval_us(scenario.targets.front()).value_or(answers_us));
  return {.age_limit_us = std::llround(checks::longest_wait_us(answers_us)), .end_us = scenario.duration_us};
}

constexpr auto parameters = [] {
  using enum messages::Parameter;
  return names_of(output_interval_ms, process_noise, air_velocity_noise_mpsprts, body_rate_noise_degpsprts,
                  attitude_noise_degprts, wind_noise_mpsprts, glider_velocity_sigma_mps,
                  glider_rate_sigma_degps, glider_attitude_sigma_deg, theta_per_s, theta_cap_per_s,
                  theta_rate_weight, adaptation_time_s, adaptation_limit, initial_air_velocity_sigma_mps,
                  initial_rate_sigma_degps, initial_wind_sigma_mps, fins_late_ms, fins_missing_ms,
                  glider_nav_coast_s, glider_nav_stale_ms, glider_nav_gate_mps, coefficient_sigma_percent,
                  nav_velocity_bias_sigma_mps, nav_attitude_bias_sigma_deg);
}();
constexpr std::array<std::string_view, 2> nodes{"glider_nav", "fins"};

constexpr std::array<std::string_view, 4> plain_marks{"waiting", "started", "updated", "theta_capped"};

}  // namespace

constinit const Estimator wind{.name = "wind",
                               .facts =
                                   {
                                       .parameters = parameters,
                                       .nodes = nodes,
                                       .truth = "wind.north",
                                       .start = scenario::Start::per_run_truth,
                                   },
                               .layout = layout,
                               .of_runs = of_runs,
                               .reception = wind_reception,
                               .samples = samples_of,
                               .tracks = tracks_of,
                               .marks = marks_of,
                               .plain_marks = plain_marks,
                               .results = results_of,
                               .closing = closing,
                               .of_own_interval = messages::WindUpdate::info.sample_group,
                               .freshness = freshness_of};

}  // namespace canhil::estimators
