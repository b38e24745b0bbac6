#include "bench/estimators/transfer_alignment/transfer_alignment.hpp"

#include <array>
#include <cmath>

#include "bench/checks/errors.hpp"
#include "bench/estimators/alignment_tracks.hpp"
#include "bench/estimators/freshness.hpp"
#include "bench/estimators/transfer_alignment/quantities.hpp"
#include "bench/scenario/scenario.hpp"
#include "messages/canhil.hpp"

namespace canhil::estimators {
namespace {

using namespace quantities;

constexpr std::array<const Quantity*, 12> kept{&misalignment_north, &misalignment_east, &misalignment_down,
                                               &attitude_roll,      &attitude_pitch,    &attitude_heading,
                                               &velocity_north,     &velocity_east,     &velocity_down,
                                               &attitude_nees,      &innovation_nis,    &heading_sigma};

constexpr std::array<const Quantity*, 4> of_runs_alone{&velocity_norm, &velocity_innovation_north,
                                                       &velocity_innovation_east, &velocity_innovation_down};

constexpr Layout layout{.kept = kept, .derived = alignment_derived, .answers_untold = true};

Samples samples_of(const checks::Observations& seen, const Truth& truth) {
  Samples samples(layout);
  const auto errors = checks::navigation_errors(seen.navigation, truth.flight);
  // One value an update, in order, up to the last one that a navigation answer follows.
  const std::vector<checks::Normalised> nees = checks::attitude_nees(seen, errors);
  for (std::size_t i = 0; i < nees.size(); ++i) {
    const checks::FilterAnswer& update = seen.filter[i];
    const auto* after = checks::first_after(errors, update.cause_us, update.navigation_us);
    if (after == nullptr) continue;
    const auto& [t_us, angles, v, phi] = *after;
    const std::array<double, kept.size()> values{
        phi.x(), phi.y(), phi.z(), angles.roll,         angles.pitch,     angles.heading,
        v.x(),   v.y(),   v.z(),   told(nees[i].value), told(update.nis), update.attitude_sigma.z()};
    samples.add(update.cause_us, values);
  }
  return samples;
}

constexpr AlignmentWords words{
    .angle = mrad,
    .navigation_closes = messages::AlignVelocityD::info.name,
    .innovation = {&velocity_innovation_north, &velocity_innovation_east, &velocity_innovation_down}};

void tracks_of(const checks::Observations& seen, const Truth& truth, const TrackSink& give) {
  const double wait_us =
      checks::longest_wait_us(1e6 * checks::nominal_period_s(seen, messages::AlignUpdate::info.name));
  AlignmentTracks(words, seen, seen.navigation, truth.flight, truth.duration_us, seen.filter, wait_us,
                  [](const checks::FilterAnswer& a, int axis) { return a.attitude_sigma(axis); })
      .give(give, checks::nis(seen, scenario::Aligner::transfer_alignment));
}

Freshness freshness_of(const scenario::Scenario& scenario) {
  double longest_us = checks::longest_wait_us(0);
  if (const auto* master = scenario.node("master_ins"))
    longest_us = checks::longest_wait_us(period_us(*master)) + static_cast<double>(master->latency_us());
  return {.age_limit_us = std::llround(longest_us), .end_us = scenario.duration_us};
}

}  // namespace

constinit const Estimator transfer_alignment{.name = "transfer_alignment",
                                             .layout = layout,
                                             .of_runs_alone = of_runs_alone,
                                             .samples = samples_of,
                                             .tracks = tracks_of,
                                             .freshness = freshness_of};

}  // namespace canhil::estimators
