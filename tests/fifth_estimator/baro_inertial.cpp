#include "tests/fifth_estimator/baro_inertial.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "bench/estimators/freshness.hpp"
#include "bench/estimators/marks.hpp"
#include "bench/estimators/names.hpp"
#include "bench/estimators/tracks.hpp"
#include "bench/scenario/scenario.hpp"
#include "messages/canhil.hpp"
#include "tests/fifth_estimator/answers.hpp"
#include "tests/fifth_estimator/quantities.hpp"

namespace canhil::estimators {
namespace {

using namespace quantities;

constexpr std::array<const Quantity*, 5> kept{&height, &velocity_down, &height_sigma, &height_nees,
                                              &height_nis};
constexpr std::array<const Quantity*, 4> of_runs{&height, &velocity_down, &height_nees, &height_nis};
constexpr Layout layout{.kept = kept};

double nees_of(const HeightAnswer& answer, double error) { return std::pow(error / answer.height_sigma, 2); }

Samples samples_of(const checks::Observations& seen, const Truth& truth) {
  Samples samples(layout);
  for (const HeightAnswer& answer : seen.of<HeightAnswers>()) {
    const HeightError error = error_of(answer, truth.flight);
    const std::array<double, kept.size()> values{error.height, error.velocity_down, answer.height_sigma,
                                                 infinite_if_nan(nees_of(answer, error.height)),
                                                 infinite_if_nan(answer.nis)};
    samples.add(answer.cause_us, values);
  }
  return samples;
}

void tracks_of(const checks::Observations& seen, const Truth& truth, const TrackSink& give) {
  const HeightAnswers& answers = seen.of<HeightAnswers>();
  const Answering of{longest_wait_us(seen, messages::HeightUpdate::info.name), truth.duration_us};
  const auto values = [&](auto point_of) {
    Spool<TrackPoint> all;
    for (const HeightAnswer& answer : answers) {
      all.push_back(point_of(answer, error_of(answer, truth.flight)));
      all.back().t_us = answer.cause_us;
    }
    return all;
  };
  Track of_height = of.track(height, "height error");
  of_height.estimate_title = "height";
  of_height.estimate_unit = metres;
  of_height.points = values([](const HeightAnswer& a, const HeightError& e) {
    return TrackPoint{
        .value = e.height, .sigma = a.height_sigma, .estimate = a.height, .truth = a.height - e.height};
  });
  give(std::move(of_height));
  Track of_velocity = of.track(velocity_down, "velocity error down");
  of_velocity.points = values([](const HeightAnswer& a, const HeightError& e) {
    return TrackPoint{.value = e.velocity_down, .sigma = a.velocity_down_sigma};
  });
  give(std::move(of_velocity));
  give(of.statistic(
      height_nis, "normalised innovation squared",
      values([](const HeightAnswer& a, const HeightError&) { return TrackPoint{.value = a.nis}; })));
  give(judged(of.statistic(height_nees, "normalised error squared",
                           values([](const HeightAnswer& a, const HeightError& e) {
                             return TrackPoint{.value = nees_of(a, e.height)};
                           }))));
}

std::vector<Mark> marks_of(const checks::Observations& seen) {
  const HeightAnswers& answers = seen.of<HeightAnswers>();
  return {{.name = "answers", .t_us = times_of(answers, every_answer)},
          {.name = "used", .t_us = times_of(answers, &HeightAnswer::used)}};
}

std::vector<ResultLine> results_of(const checks::Observations& seen, const Truth& truth,
                                   std::string_view /*algorithm*/) {
  ResultLine line{.name = "final_error", .what = "error at the end"};
  if (seen.of<HeightAnswers>().empty()) return {line};
  const HeightError error = error_of(seen.of<HeightAnswers>().back(), truth.flight);
  line.figures = {
      {.name = "height", .value = error.height, .text = fmt::format("height {:+.3f} m", error.height)},
      {.name = "velocity_down",
       .value = error.velocity_down,
       .text = fmt::format("velocity down {:+.3f} m/s", error.velocity_down)}};
  return {line};
}

constexpr std::array closing{messages::HeightUpdate::info.name};

Freshness freshness_of(const scenario::Scenario& scenario) {
  const scenario::NodeSettings* barometer = scenario.node("barometer");
  if (barometer == nullptr) return {};
  return {
      .age_limit_us = std::llround(checks::longest_wait_us(period_us(*barometer))) + barometer->latency_us(),
      .end_us = scenario.duration_us};
}

constexpr auto parameters = [] {
  using enum messages::Parameter;
  return names_of(accel_bias_sigma_ug, accel_noise_ugprthz, fix_noise_vertical_m, gate_nis);
}();
constexpr std::array<std::string_view, 2> nodes{"slave_imu", "barometer"};

constexpr std::array<std::string_view, 1> plain_marks{"used"};

}  // namespace

constinit const Estimator baro_inertial{.name = "baro_inertial",
                                        .facts = {.parameters = parameters, .nodes = nodes},
                                        .layout = layout,
                                        .of_runs = of_runs,
                                        .reception = height_reception,
                                        .samples = samples_of,
                                        .tracks = tracks_of,
                                        .marks = marks_of,
                                        .plain_marks = plain_marks,
                                        .results = results_of,
                                        .closing = closing,
                                        .freshness = freshness_of};

}  // namespace canhil::estimators
