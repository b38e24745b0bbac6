#include "bench/estimators/inflight_alignment/inflight_alignment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/estimators/alignment.hpp"
#include "bench/estimators/freshness.hpp"
#include "bench/estimators/inflight_alignment/answers.hpp"
#include "bench/estimators/inflight_alignment/quantities.hpp"
#include "bench/estimators/names.hpp"
#include "bench/estimators/trust.hpp"
#include "bench/scenario/scenario.hpp"
#include "messages/canhil.hpp"

namespace canhil::estimators {
namespace {

using namespace quantities;

constexpr std::array<const Quantity*, 18> kept{
    &misalignment_north,  &misalignment_east, &misalignment_down, &attitude_roll, &attitude_pitch,
    &attitude_heading,    &velocity_north,    &velocity_east,     &velocity_down, &innovation_nis,
    &position_north,      &position_east,     &position_down,     &heading_sigma, &covariance_repairs,
    &velocity_down_sigma, &error_over_sigma,  &degraded};

constexpr auto of_runs = and_alignment_reported(
    std::array<const Quantity*, 10>{&position_north, &position_east, &position_down, &position_horizontal,
                                    &position_norm, &position_innovation_north, &position_innovation_east,
                                    &position_innovation_down, &innovation_nis, &heading_nees});

double velocity_down_over_its_sigma(const Samples& samples, std::size_t index) {
  return samples.value(index, velocity_down) / samples.value(index, velocity_down_sigma);
}

constexpr std::array derived{
    alignment_derived[0], Derived{.quantity = &velocity_down_over_sigma, .of = velocity_down_over_its_sigma},
    derived_trust};

constexpr Layout layout{.kept = kept, .derived = derived, .answers_may_omit = true};

Samples samples_of(const checks::Observations& seen, const Truth& truth) {
  Samples samples(layout);
  const InflightAnswers& answers = seen.of<InflightAnswers>();
  for (const FixAnswer& update : answers.fixes) {
    if (!has_time_and_truth(update, truth.flight)) continue;
    const auto after = answers.navigation.first_after(update.cause_us, update.navigation_us, truth.flight);
    if (!after) continue;
    const auto& [t_us, angles, v, phi, answer] = *after;
    const world::Vector3 p = position_error(update, truth.flight);
    const double nis =
        used(update.outcome) ? infinite_if_nan(update.nis) : std::numeric_limits<double>::quiet_NaN();
    const double largest =
        std::max({over_sigma(phi, update.attitude_sigma), over_sigma(v, update.velocity_sigma),
                  over_sigma(p, update.position_sigma)});
    const std::array<double, kept.size()> values{phi.x(),
                                                 phi.y(),
                                                 phi.z(),
                                                 angles.roll,
                                                 angles.pitch,
                                                 angles.heading,
                                                 v.x(),
                                                 v.y(),
                                                 v.z(),
                                                 nis,
                                                 p.x(),
                                                 p.y(),
                                                 p.z(),
                                                 update.attitude_sigma.z(),
                                                 static_cast<double>(update.repairs),
                                                 update.velocity_sigma.z(),
                                                 largest,
                                                 update.degraded ? 1.0 : 0.0};
    samples.add(update.cause_us, values);
  }
  return samples;
}

// How long [us] the target may send no answer to a fix before this counts as silence. Several fixes in a row
// may go unanswered. This time is computed from the median interval between sent fixes, because the bench may
// withhold fixes on purpose; with two sources, the interval of the slower source is used.
double wait_for_fixes_us(const InflightAnswers& answers) {
  double period_us = 0;
  for (const messages::FixSource source : messages::enumerators<messages::FixSource>) {
    std::vector<std::int64_t> periods_us;
    std::optional<std::int64_t> before_us;
    for (const SentFix& fix : answers.sent) {
      if (fix.source != source) continue;
      if (before_us) periods_us.push_back(fix.valid_us - *before_us);
      before_us = fix.valid_us;
    }
    if (periods_us.empty()) continue;
    const auto middle = periods_us.begin() + static_cast<std::ptrdiff_t>(periods_us.size() / 2);
    std::ranges::nth_element(periods_us, middle);
    period_us = std::max(period_us, static_cast<double>(*middle));
  }
  return checks::longest_wait_us(period_us, checks::tolerated_fixes + 1);
}

void give_positions(const InflightAnswers& answers, const Answering& filters, const Truth& truth,
                    const TrackSink& give) {
  const auto fill = [&](Track track, auto point_of) {
    for (const FixAnswer& fix : answers.fixes) {
      if (!has_time_and_truth(fix, truth.flight)) continue;
      track.points.push_back(point_of(fix, position_error(fix, truth.flight)));
      track.points.back().t_us = fix.cause_us;
    }
    give(std::move(track));
  };
  each_axis({&position_north, &position_east, &position_down},
            [&](const Quantity& quantity, const std::string& name, int axis) {
              fill(filters.track(quantity, "position error " + name),
                   [=](const FixAnswer& fix, const world::Vector3& error) {
                     return TrackPoint{.value = error(axis), .sigma = fix.position_sigma(axis)};
                   });
            });
  fill(judged(filters.track(position_horizontal, "position error horizontal")),
       [](const auto&, const world::Vector3& error) { return TrackPoint{.value = error.head<2>().norm()}; });
  fill(judged(filters.track(position_norm, "position error norm")),
       [](const auto&, const world::Vector3& error) { return TrackPoint{.value = error.norm()}; });
}

void tracks_of(const checks::Observations& seen, const Truth& truth, const TrackSink& give) {
  const InflightAnswers& answers = seen.of<InflightAnswers>();
  const auto& errors = answers.navigation.errors(truth.flight);
  // Fixes that the bench withheld on purpose need no answer.
  const auto unanswered = [&answers](std::int64_t from_us, std::int64_t to_us) {
    return unanswered_fixes(answers, {.from_us = from_us, .to_us = to_us});
  };
  const Alignment alignment{
      .angle = degrees,
      .innovation = {&position_innovation_north, &position_innovation_east, &position_innovation_down},
      .navigation = answers.navigation,
      .errors = errors,
      .navigates = {longest_wait_us(seen, messages::FixVelocityD::info.name), truth.duration_us},
      .filters = {wait_for_fixes_us(answers), truth.duration_us, unanswered}};
  give_alignment(alignment, answers.fixes, give);
  Spool<TrackPoint> nis, of_heading;
  for (const FixAnswer& answer : answers.fixes) {
    if (!used(answer.outcome)) continue;
    nis.push_back({.t_us = answer.cause_us, .value = answer.nis});
    add_heading_nees(of_heading, answers.navigation, truth.flight, answer);
  }
  const Answering& filters = alignment.filters;
  give(filters.statistic(innovation_nis, "normalised innovation squared", std::move(nis)));
  give(judged(
      filters.statistic(heading_nees, "normalised error squared of the heading", std::move(of_heading))));
  give_positions(answers, filters, truth, give);
}

// The marks are: all navigation answers; the navigation answers that bridged lost input; for each outcome,
// the fixes with this outcome; the fixes at which the count of covariance repairs rose; the fixes whose
// answers report `degraded`; the fixes after which the heading was resolved and fed back.
std::vector<Mark> marks_of(const checks::Observations& seen) {
  const InflightAnswers& answers = seen.of<InflightAnswers>();
  std::vector<Mark> marks{
      {.name = "answers", .t_us = times_of(answers.navigation, every_answer)},
      {.name = "coasting", .t_us = times_of(answers.navigation, &NavigationAnswer::coasting)}};
  add_marks(marks, answers.fixes, &FixAnswer::outcome, messages::enumerators<messages::FixOutcome>);
  marks.push_back({.name = "repaired", .among = {}, .t_us = times_of(answers.fixes, &FixAnswer::repaired)});
  marks.push_back({.name = "degraded", .among = {}, .t_us = times_of(answers.fixes, &FixAnswer::degraded)});
  marks.push_back(
      {.name = "handed_over", .among = {}, .t_us = times_of(answers.fixes, &FixAnswer::handed_over)});
  return marks;
}

std::vector<ResultLine> results_of(const checks::Observations& seen, const Truth& truth,
                                   std::string_view algorithm) {
  constexpr std::array bands_deg{30.0, 10.0, 3.0, 1.0};
  const InflightAnswers& answers = seen.of<InflightAnswers>();
  auto lines = alignment_results(answers.navigation.errors(truth.flight), bands_deg, degrees);
  if (answers.fixes.empty()) return lines;
  const FixAnswer& last = answers.fixes.back();
  ResultLine filter{.name = "filter", .what = "filter"};
  filter.add("repairs", last.repairs, fmt::format("repairs of the covariance {}", last.repairs));
  // The algorithm sin_cos does not feed the heading back to the INS until the heading is resolved.
  const auto resolved = std::ranges::find(answers.fixes, true, &FixAnswer::handed_over);
  if (resolved != answers.fixes.end()) {
    const double t_s = static_cast<double>(resolved->cause_us) / 1e6;
    filter.add("resolved", t_s, fmt::format("heading fed back to the INS at {:g} s", t_s));
  } else if (algorithm == name_of(messages::Algorithm::sin_cos)) {
    filter.add("resolved", std::nullopt, "heading not fed back to the INS by the end");
  }
  const double heading_sigma_deg = last.attitude_sigma.z() / degrees.factor;
  filter.add("heading_sigma", last.attitude_sigma.z(),
             fmt::format("heading sigma reported at the end {:.3f} deg", heading_sigma_deg));
  lines.push_back(std::move(filter));
  return lines;
}

constexpr std::array closing{messages::FixVelocityD::info.name, messages::FixUpdate::info.name};

// With two sources, the period of the slower source is used, because the filter may use only that source.
Freshness freshness_of(const scenario::Scenario& scenario) {
  double longest_us = checks::longest_wait_us(0);
  for (const scenario::NodeSettings& node : scenario.nodes) {
    if (node.table().aid) longest_us = std::max(longest_us, longest_wait_of_fixes_us(node));
  }
  return {.age_limit_us = std::llround(longest_us), .end_us = scenario.duration_us};
}

constexpr auto parameters = [] {
  using enum messages::Parameter;
  return names_of(accel_bias_sigma_ug, gyro_bias_sigma_degph, accel_noise_ugprthz, gyro_noise_degprth,
                  closed_loop, output_interval_ms, aiding, attitude_error_frame, ukf_root, ukf_covariance,
                  fix_noise_horizontal_m, fix_noise_vertical_m, fix_bias_sigma_m, fix_bias_walk_mprts,
                  initial_height_sigma_m, handover_sigma_deg, gate_nis, gate_recovery, late_fixes,
                  fix_correlated_percent, fix_correlation_s);
}();
constexpr std::array<std::string_view, 1> nodes{"slave_imu"};

constexpr std::array<std::string_view, 2> plain_marks{"accepted", "handed_over"};

}  // namespace

constinit const Estimator inflight_alignment{
    .name = "inflight_alignment",
    .facts = {.parameters = parameters, .nodes = nodes, .aided_by = name_of(messages::Parameter::aiding)},
    .layout = layout,
    .of_runs = of_runs,
    .reception = inflight_reception,
    .samples = samples_of,
    .tracks = tracks_of,
    .marks = marks_of,
    .plain_marks = plain_marks,
    .results = results_of,
    .closing = closing,
    .of_own_interval = messages::FixVelocityD::info.sample_group,
    .freshness = freshness_of};

}  // namespace canhil::estimators
