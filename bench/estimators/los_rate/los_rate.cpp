#include "bench/estimators/los_rate/los_rate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "bench/estimators/end_of_flight.hpp"
#include "bench/estimators/freshness.hpp"
#include "bench/estimators/los_rate/answers.hpp"
#include "bench/estimators/los_rate/miss_distance.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/estimators/marks.hpp"
#include "bench/estimators/names.hpp"
#include "bench/estimators/tracks.hpp"
#include "bench/estimators/trust.hpp"
#include "bench/scenario/scenario.hpp"
#include "messages/canhil.hpp"

namespace canhil::estimators {
namespace {

using namespace quantities;

constexpr std::array<const Quantity*, 10> kept{
    &los_rate_pitch, &los_rate_yaw,        &los_mean_nis,     &miss_pitch,         &miss_yaw,
    &los_rate_sigma, &los_rate_over_sigma, &error_over_sigma, &trusted_over_sigma, &degraded};

double both_planes(const Samples& samples, std::size_t index) {
  const double pitch = samples.value(index, los_rate_pitch), yaw = samples.value(index, los_rate_yaw);
  return std::sqrt((pitch * pitch + yaw * yaw) / 2);
}
double miss_of(const Samples& samples, std::size_t index) {
  return std::hypot(samples.value(index, miss_pitch), samples.value(index, miss_yaw));
}
constexpr std::array derived{Derived{.quantity = &los_rate_both, .of = both_planes},
                             Derived{.quantity = &miss_distance, .of = miss_of}};

constexpr std::int64_t stretch_us = 20'000;
constexpr std::array<const Quantity*, 4> of_runs{&los_rate_pitch, &los_rate_yaw, &los_rate_both, &los_nis};

constexpr Layout layout{
    .kept = kept, .derived = derived, .to_go_stretch_us = stretch_us, .end_known_by = &miss_distance};

/// Sums over one stretch of the time to go.
struct Stretch {
  double pitch_squares = 0, yaw_squares = 0, nis_sum = 0;
  double variances = 0, over_variances = 0, over_sigma = 0, trusted = 0;
  int rates = 0, updates = 0, untrusted = 0;
};

Samples samples_of(const checks::Observations& seen, const Truth& truth) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Samples samples(layout);
  const auto los = TrueLos::find(truth.plants, true_los);
  if (!los) return samples;
  std::map<std::int64_t, Stretch> stretches;  // key: minus the time to go, in units of stretch_us
  const auto at = [&](double time_to_go) -> Stretch& {
    return stretches[-static_cast<std::int64_t>(
        std::floor(time_to_go * 1e6 / static_cast<double>(stretch_us)))];
  };
  for (const LosError& error : los_errors(seen.of<LosAnswers>(), truth.plants)) {
    Stretch& stretch = at(error.time_to_go);
    stretch.pitch_squares += error.rate.pitch * error.rate.pitch;
    stretch.yaw_squares += error.rate.yaw * error.rate.yaw;
    const double pitch = error.rate.pitch / error.sigma.pitch, yaw = error.rate.yaw / error.sigma.yaw;
    stretch.variances += error.sigma.pitch * error.sigma.pitch + error.sigma.yaw * error.sigma.yaw;
    stretch.over_variances += pitch * pitch + yaw * yaw;
    ++stretch.rates;
    const double larger = std::max(over_sigma(error.rate.pitch, error.sigma.pitch),
                                   over_sigma(error.rate.yaw, error.sigma.yaw));
    stretch.over_sigma = std::max(stretch.over_sigma, larger);
    if (error.trusted)
      stretch.trusted = std::max(stretch.trusted, larger);
    else
      ++stretch.untrusted;
  }
  for (const TrackPoint& update : nis_of(seen.of<LosAnswers>())) {
    const auto row = los->record().row(update.t_us);
    if (!row) continue;
    Stretch& stretch = at(los->of_row(*row).back());
    stretch.nis_sum += update.value;
    ++stretch.updates;
  }
  const auto passage = Passage::find(truth.plants);
  const world::Vector3 miss_n = passage && passage->miss_n ? *passage->miss_n : world::Vector3::Constant(nan);
  for (const auto& [index, stretch] : stretches) {
    if (stretch.rates == 0) continue;
    const std::array<double, kept.size()> values{
        std::sqrt(stretch.pitch_squares / stretch.rates),
        std::sqrt(stretch.yaw_squares / stretch.rates),
        stretch.updates > 0 ? infinite_if_nan(stretch.nis_sum / stretch.updates) : nan,
        miss_n.z(),
        miss_n.y(),
        std::sqrt(stretch.variances / (2 * stretch.rates)),
        std::sqrt(stretch.over_variances / (2 * stretch.rates)),
        stretch.over_sigma,
        stretch.trusted,
        static_cast<double>(stretch.untrusted) / stretch.rates};
    samples.add((index - 1) * stretch_us, values);
  }
  return samples;
}

void tracks_of(const checks::Observations& seen, const Truth& truth, const TrackSink& give) {
  if (!TrueLos::find(truth.plants, true_los)) return;
  const LosAnswers& answers = seen.of<LosAnswers>();
  const auto errors = los_errors(answers, truth.plants);
  // In the last moments before the passage the rate grows too large to draw.
  constexpr double least_to_go_s = 0.08;
  const auto last = std::find_if(errors.rbegin(), errors.rend(),
                                 [](const LosError& e) { return e.time_to_go >= least_to_go_s; });
  const Answering of{longest_wait_us(seen, messages::LosRateTarget::info.name),
                     answers_end_us(truth.plants, truth.duration_us)};
  const auto plane = [&](const Quantity& quantity, const std::string& name,
                         double world::Planes<double>::*member) {
    Track track = of.track(quantity, "LOS rate error, " + name);
    track.drawn_until_us = last == errors.rend() ? 0 : last->t_us;
    track.estimate_title = "LOS rate, " + name;
    track.estimate_unit = mradps;
    for (const LosError& e : errors) {
      const LosAnswer& answer = answers[e.answer];
      track.points.push_back({.t_us = e.t_us,
                              .value = e.rate.*member,
                              .sigma = answer.rate_sigma.*member,
                              .estimate = answer.rate.*member,
                              .truth = answer.rate.*member - e.rate.*member});
    }
    give(std::move(track));
  };
  plane(los_rate_pitch, "pitch", &world::Planes<double>::pitch);
  plane(los_rate_yaw, "yaw", &world::Planes<double>::yaw);
  give(of.statistic(los_nis, "normalised innovation squared", nis_of(answers)));
}

std::vector<Mark> marks_of(const checks::Observations& seen) {
  const LosAnswers& answers = seen.of<LosAnswers>();
  std::vector<Mark> marks{{.name = "answers", .t_us = times_of(answers, every_answer)}};
  add_marks(marks, answers, &LosAnswer::outcome, messages::enumerators<messages::LosRateOutcome>);
  marks.push_back({.name = "degraded", .t_us = times_of(answers, &LosAnswer::degraded)});
  marks.push_back({.name = "blind", .t_us = times_of(answers, &LosAnswer::blind)});
  return marks;
}

std::vector<ResultLine> results_of(const checks::Observations& seen, const Truth& truth,
                                   std::string_view /*algorithm*/) {
  const auto passage = Passage::find(truth.plants);
  if (!passage) return {};
  ResultLine rms{.name = "rms", .what = "RMS [mrad/s] by s to go"};
  constexpr std::array<std::pair<double, double>, 6> windows{
      {{4.5, 3}, {3, 2}, {2, 1}, {1, 0.5}, {0.5, 0.2}, {0.2, 0.08}}};
  const auto errors = los_errors(seen.of<LosAnswers>(), truth.plants);
  for (const auto& [most, least] : windows) {
    const std::optional<double> value = los_rms(errors, least, most);
    const std::string name = fmt::format("{:g} to {:g}", most, least);
    rms.add(name, value, name + (value ? fmt::format(": {:.2f}", *value / mradps.factor) : ": no answers"));
  }
  return {end_of_flight(*passage), std::move(rms)};
}

constexpr std::array closing{messages::LosRateTarget::info.name};

constexpr std::array check_kinds{checks::check_kind<MissDistance>};

Freshness freshness_of(const scenario::Scenario& scenario) {
  const scenario::NodeSettings* seeker = scenario.node("seeker");
  const scenario::PlantFacts* missile = scenario.plant_with("plant.time_to_go");
  if (missile == nullptr || seeker == nullptr) return {};
  return {.age_limit_us = std::llround(checks::longest_wait_us(period_us(*seeker))),
          .end_us = 0,
          .begin_us = -std::llround(missile->to_go_s * 1e6),
          .sample_us = std::max(stretch_us, seeker->period_us())};
}

constexpr auto parameters = [] {
  using enum messages::Parameter;
  return names_of(jerk_density_m2ps5, thermal_noise_pitch_radpm2, thermal_noise_yaw_radpm2,
                  glint_noise_pitch_m, glint_noise_yaw_m, constant_noise_pitch_rad, constant_noise_yaw_rad,
                  sample_period_ms, los_rate_sigma_radps, target_acceleration_sigma_mps2, start_up_s,
                  gap_limit_ms, low_pass_bandwidth_radps, low_pass_damping, range_max_m,
                  closing_speed_max_mps, blind_range_m, range_sigma_m, range_gate_m, closing_speed_gate_mps,
                  relock_samples, range_unchanged_limit_ms, field_of_view_rad, antenna_rate_sigma_radps,
                  missile_acceleration_sigma_mps2, antenna_rate_bias_sigma_radps);
}();
constexpr std::array<std::string_view, 1> nodes{"seeker"};

constexpr std::array<std::string_view, 4> plain_marks{"waiting", "started", "start_up", "updated"};

}  // namespace

constinit const Estimator los_rate{.name = "los_rate",
                                   .facts = {.parameters = parameters,
                                             .nodes = nodes,
                                             .truth = "plant.range",
                                             .start = scenario::Start::nothing},
                                   .layout = layout,
                                   .of_runs = of_runs,
                                   .reception = los_reception,
                                   .samples = samples_of,
                                   .tracks = tracks_of,
                                   .marks = marks_of,
                                   .plain_marks = plain_marks,
                                   .results = results_of,
                                   .closing = closing,
                                   .check_kinds = check_kinds,
                                   .freshness = freshness_of};

}  // namespace canhil::estimators
