#include "bench/estimators/inflight_alignment/inflight_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bench/checks/errors.hpp"
#include "bench/estimators/alignment_tracks.hpp"
#include "bench/estimators/freshness.hpp"
#include "bench/estimators/inflight_alignment/quantities.hpp"
#include "bench/scenario/scenario.hpp"
#include "messages/canhil.hpp"

namespace canhil::estimators {
namespace {

using namespace quantities;

constexpr std::array<const Quantity*, 15> kept{
    &misalignment_north, &misalignment_east, &misalignment_down, &attitude_roll, &attitude_pitch,
    &attitude_heading,   &velocity_north,    &velocity_east,     &velocity_down, &innovation_nis,
    &position_north,     &position_east,     &position_down,     &heading_sigma, &covariance_repairs};

constexpr std::array<const Quantity*, 6> of_runs_alone{&velocity_norm,
                                                       &position_horizontal,
                                                       &position_norm,
                                                       &position_innovation_north,
                                                       &position_innovation_east,
                                                       &position_innovation_down};

constexpr Layout layout{.kept = kept, .derived = alignment_derived, .answers_untold = true};

Samples samples_of(const checks::Observations& seen, const Truth& truth) {
  Samples samples(layout);
  const auto errors = checks::navigation_errors(seen.fix_navigation, truth.flight);
  for (const checks::FixAnswer& update : seen.fixes) {
    if (!checks::tells_of_its_time(update, truth.flight)) continue;
    const auto* after = checks::first_after(errors, update.cause_us, update.navigation_us);
    if (after == nullptr) continue;
    const auto& [t_us, angles, v, phi] = *after;
    const world::Vector3 p = checks::position_error(update, truth.flight);
    const double nis =
        checks::used(update.outcome) ? told(update.nis) : std::numeric_limits<double>::quiet_NaN();
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
                                                 update.heading_sigma,
                                                 static_cast<double>(update.repairs)};
    samples.add(update.cause_us, values);
  }
  return samples;
}

constexpr AlignmentWords words{
    .angle = degrees,
    .navigation_closes = messages::FixVelocityD::info.name,
    .innovation = {&position_innovation_north, &position_innovation_east, &position_innovation_down}};

// The longest time that is no silence between answers to fixes: so many in a row may go unanswered. By the
// median, as the bench may keep fixes back on purpose; of two sources the slower one counts.
double longest_wait_us(const checks::Observations& seen) {
  double period_us = 0;
  for (const messages::FixSource source : messages::enumerators<messages::FixSource>) {
    std::vector<std::int64_t> periods_us;
    std::optional<std::int64_t> before_us;
    for (const checks::SentFix& fix : seen.sent_fixes) {
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

double misalignment_sigma(const checks::FixAnswer& answer, int axis) {
  return axis == 0 ? answer.tilt_sigma_north : axis == 1 ? answer.tilt_sigma_east : answer.heading_sigma;
}

void give_position(const checks::Observations& seen, const Truth& truth, double wait_us,
                   const TrackSink& give) {
  const auto add = [&](const Quantity& quantity, std::string title, bool only_if_judged, auto told) {
    Track track{.quantity = &quantity,
                .unit = metres,
                .title = "position error " + std::move(title),
                .only_if_judged = only_if_judged,
                .longest_wait_us = wait_us,
                .answers_end_us = truth.duration_us};
    for (const checks::FixAnswer& fix : seen.fixes) {
      if (!checks::tells_of_its_time(fix, truth.flight)) continue;
      track.told.push_back(told(fix, checks::position_error(fix, truth.flight)));
      track.told.back().t_us = fix.cause_us;
    }
    give(std::move(track));
  };
  const auto component = [](int axis) {
    return [axis](const checks::FixAnswer& fix, const world::Vector3& error) {
      return Told{.value = error(axis), .sigma = fix.position_sigma(axis)};
    };
  };
  add(position_north, "north", false, component(0));
  add(position_east, "east", false, component(1));
  add(position_down, "down", false, component(2));
  add(position_horizontal, "horizontal", true,
      [](const auto&, const world::Vector3& error) { return Told{.value = error.head<2>().norm()}; });
  add(position_norm, "norm", true,
      [](const auto&, const world::Vector3& error) { return Told{.value = error.norm()}; });
}

void tracks_of(const checks::Observations& seen, const Truth& truth, const TrackSink& give) {
  const double wait_us = longest_wait_us(seen);
  AlignmentTracks(words, seen, seen.fix_navigation, truth.flight, truth.duration_us, seen.fixes, wait_us,
                  misalignment_sigma)
      .give(give, checks::nis(seen, scenario::Aligner::inflight_alignment));
  give_position(seen, truth, wait_us, give);
}

// Where there are two sources, that which is heard least: the filter may use it alone.
Freshness freshness_of(const scenario::Scenario& scenario) {
  double longest_us = checks::longest_wait_us(0);
  for (const scenario::NodeSettings& node : scenario.nodes) {
    if (node.table().aid) longest_us = std::max(longest_us, longest_wait_of_fixes_us(node));
  }
  return {.age_limit_us = std::llround(longest_us), .end_us = scenario.duration_us};
}

}  // namespace

constinit const Estimator inflight_alignment{.name = "inflight_alignment",
                                             .layout = layout,
                                             .of_runs_alone = of_runs_alone,
                                             .samples = samples_of,
                                             .tracks = tracks_of,
                                             .freshness = freshness_of};

}  // namespace canhil::estimators
