#include "bench/estimators/transfer_alignment/transfer_alignment.hpp"

#include <array>
#include <cmath>

#include "bench/estimators/alignment.hpp"
#include "bench/estimators/freshness.hpp"
#include "bench/estimators/names.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"
#include "bench/estimators/transfer_alignment/quantities.hpp"
#include "bench/estimators/trust.hpp"
#include "bench/scenario/scenario.hpp"
#include "messages/canhil.hpp"

namespace canhil::estimators {
namespace {

using namespace quantities;

constexpr std::array<const Quantity*, 14> kept{
    &misalignment_north, &misalignment_east, &misalignment_down, &attitude_roll, &attitude_pitch,
    &attitude_heading,   &velocity_north,    &velocity_east,     &velocity_down, &attitude_nees,
    &innovation_nis,     &heading_sigma,     &error_over_sigma,  &degraded};

constexpr auto of_runs = and_alignment_reported(std::array<const Quantity*, 6>{
    &velocity_innovation_north, &velocity_innovation_east, &velocity_innovation_down, &innovation_nis,
    &attitude_nees, &heading_nees});

constexpr std::array derived{alignment_derived[0], derived_trust};

constexpr Layout layout{.kept = kept, .derived = derived, .answers_may_omit = true};

Samples samples_of(const checks::Observations& seen, const Truth& truth) {
  Samples samples(layout);
  const TransferAnswers& answers = seen.of<TransferAnswers>();
  for (const FilterAnswer& update : answers.filter) {
    const auto after = answers.navigation.first_after(update.cause_us, update.navigation_us, truth.flight);
    if (!after) continue;
    const auto& [t_us, angles, v, phi, answer] = *after;
    const double normalised = nees(phi, update.attitude_sigma, update.attitude_correlation);
    // Only the attitude is compared with its reported sigma. The reported velocity sigma is valid only at the
    // time of the cause: during an acceleration of 1 g, a heading error causes a velocity error that exceeds
    // this sigma before the next answer.
    const std::array<double, kept.size()> values{phi.x(),
                                                 phi.y(),
                                                 phi.z(),
                                                 angles.roll,
                                                 angles.pitch,
                                                 angles.heading,
                                                 v.x(),
                                                 v.y(),
                                                 v.z(),
                                                 infinite_if_nan(normalised),
                                                 infinite_if_nan(update.nis),
                                                 update.attitude_sigma.z(),
                                                 over_sigma(phi, update.attitude_sigma),
                                                 update.degraded ? 1.0 : 0.0};
    samples.add(update.cause_us, values);
  }
  return samples;
}

void tracks_of(const checks::Observations& seen, const Truth& truth, const TrackSink& give) {
  const TransferAnswers& answers = seen.of<TransferAnswers>();
  const auto& errors = answers.navigation.errors(truth.flight);
  const Alignment alignment{
      .angle = mrad,
      .innovation = {&velocity_innovation_north, &velocity_innovation_east, &velocity_innovation_down},
      .navigation = answers.navigation,
      .errors = errors,
      .navigates = {longest_wait_us(seen, messages::AlignVelocityD::info.name), truth.duration_us},
      .filters = {longest_wait_us(seen, messages::AlignUpdate::info.name), truth.duration_us}};
  give_alignment(alignment, answers.filter, give);
  Spool<TrackPoint> nis, of_heading;
  for (const FilterAnswer& answer : answers.filter) {
    nis.push_back({.t_us = answer.cause_us, .value = answer.nis});
    add_heading_nees(of_heading, answers.navigation, truth.flight, answer);
  }
  const Answering& filters = alignment.filters;
  give(filters.statistic(innovation_nis, "normalised innovation squared", std::move(nis)));
  give(judged(filters.statistic(attitude_nees, "normalised error squared of the attitude",
                                nees_of(answers, truth.flight))));
  give(judged(
      filters.statistic(heading_nees, "normalised error squared of the heading", std::move(of_heading))));
}

std::vector<Mark> marks_of(const checks::Observations& seen) {
  const TransferAnswers& answers = seen.of<TransferAnswers>();
  return {
      {.name = "answers", .t_us = times_of(answers.navigation, every_answer)},
      {.name = "coasting", .t_us = times_of(answers.navigation, &NavigationAnswer::coasting)},
      {.name = "updates", .t_us = times_of(answers.filter, every_answer)},
      {.name = "degraded", .among = "updates", .t_us = times_of(answers.filter, &FilterAnswer::degraded)}};
}

std::vector<ResultLine> results_of(const checks::Observations& seen, const Truth& truth,
                                   std::string_view /*algorithm*/) {
  constexpr std::array bands_mrad{10.0, 3.0, 2.0, 1.0};
  return alignment_results(seen.of<TransferAnswers>().navigation.errors(truth.flight), bands_mrad, mrad);
}

constexpr std::array closing{messages::AlignVelocityD::info.name, messages::AlignUpdate::info.name};

Freshness freshness_of(const scenario::Scenario& scenario) {
  double longest_us = checks::longest_wait_us(0);
  if (const auto* master = scenario.node("master_ins"))
    longest_us = checks::longest_wait_us(period_us(*master)) + static_cast<double>(master->latency_us());
  return {.age_limit_us = std::llround(longest_us), .end_us = scenario.duration_us};
}

constexpr auto parameters = [] {
  using enum messages::Parameter;
  return names_of(accel_bias_sigma_ug, gyro_bias_sigma_degph, accel_noise_ugprthz, gyro_noise_degprth,
                  velocity_noise_m2ps, h2_case, h2_alpha_rule, h2_alpha_mps2, fading_per_s, mechanization,
                  closed_loop, output_interval_ms, gate_nis, gate_recovery, accel_scale_factor_sigma_ppm,
                  accel_misalignment_sigma_mrad, gyro_scale_factor_sigma_ppm, gyro_misalignment_sigma_mrad,
                  lever_arm_sigma_m, velocity_correlated_mps, velocity_correlation_s);
}();
constexpr std::array<std::string_view, 2> nodes{"slave_imu", "master_ins"};

constexpr std::array<std::string_view, 1> plain_marks{"updates"};

}  // namespace

constinit const Estimator transfer_alignment{.name = "transfer_alignment",
                                             .facts = {.parameters = parameters, .nodes = nodes},
                                             .layout = layout,
                                             .of_runs = of_runs,
                                             .reception = transfer_reception,
                                             .samples = samples_of,
                                             .tracks = tracks_of,
                                             .marks = marks_of,
                                             .plain_marks = plain_marks,
                                             .results = results_of,
                                             .closing = closing,
                                             .of_own_interval = messages::AlignVelocityD::info.sample_group,
                                             .freshness = freshness_of};

}  // namespace canhil::estimators
