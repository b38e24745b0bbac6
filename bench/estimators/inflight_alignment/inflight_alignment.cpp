#include "bench/estimators/inflight_alignment/inflight_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/checks/errors.hpp"
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

double over_sigma(const Samples& samples, std::size_t place) {
  return samples.value(place, attitude_heading) / samples.value(place, heading_sigma);
}
constexpr std::array derived{Derived{.quantity = &heading_over_sigma, .of = over_sigma}};

// A gated fix was answered, but has no NIS.
constexpr Layout layout{.kept = kept, .derived = derived, .answers_untold = true};

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

// Where there are two sources, that which is heard least: the filter may use it alone.
Freshness freshness_of(const scenario::Scenario& scenario) {
  double longest_us = checks::longest_wait_us(0);
  if (scenario.ssbl) {
    longest_us = std::max(longest_us, longest_wait_of_fixes_us(scenario.ssbl->schedule,
                                                               messages::SsblRelativeD::info.cycle_time_us,
                                                               scenario.ssbl->faults));
  }
  if (scenario.gps) {
    longest_us = std::max(
        longest_us, longest_wait_of_fixes_us(scenario.gps->schedule, messages::GpsTime::info.cycle_time_us,
                                             scenario.gps->faults));
  }
  return {.age_limit_us = std::llround(longest_us), .end_us = scenario.duration_us};
}

}  // namespace

constinit const Estimator inflight_alignment{
    .name = "inflight_alignment", .layout = layout, .samples = samples_of, .freshness = freshness_of};

}  // namespace canhil::estimators
