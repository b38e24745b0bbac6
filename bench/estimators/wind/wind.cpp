#include "bench/estimators/wind/wind.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/checks/wind.hpp"
#include "bench/estimators/freshness.hpp"
#include "bench/estimators/wind/quantities.hpp"
#include "bench/scenario/scenario.hpp"
#include "messages/canhil.hpp"

namespace canhil::estimators {
namespace {

using namespace quantities;

constexpr std::array<const Quantity*, 6> kept{&wind_along, &wind_cross, &wind_down,
                                              &wind_nis,   &wind_nees,  &wind_along_sigma};

double of_all_three(const Samples& samples, std::size_t place) {
  return std::hypot(samples.value(place, wind_along), samples.value(place, wind_cross),
                    samples.value(place, wind_down));
}
constexpr std::array derived{Derived{.quantity = &wind_norm, .of = of_all_three}};

constexpr Layout layout{.kept = kept, .derived = derived};

Samples samples_of(const checks::Observations& seen, const Truth& truth) {
  Samples samples(layout);
  if (truth.glide == nullptr) return samples;
  const auto errors = checks::wind_errors(seen, *truth.glide);
  const auto normalised = checks::wind_nees(seen, *truth.glide);  // one for each error
  auto answer = seen.wind.begin();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    while (!answer->started || answer->cause_us != errors[i].t_us) ++answer;
    const bool updated = answer->outcome == messages::WindOutcome::updated;
    const std::array<double, kept.size()> values{
        errors[i].along_track,     errors[i].cross_track,
        errors[i].error_n.z(),     updated ? told(answer->nis) : std::numeric_limits<double>::quiet_NaN(),
        told(normalised[i].value), answer->along_track_sigma};
    samples.add(errors[i].t_us, values);
    ++answer;
  }
  return samples;
}

// The filter may answer less often than it is told of the navigation.
Freshness freshness_of(const scenario::Scenario& scenario) {
  if (!scenario.glider_nav) return {};
  double answers_us =
      period_us(scenario.glider_nav->schedule, messages::GliderNavVelocityD::info.cycle_time_us);
  for (const scenario::Parameter& parameter : scenario.targets.front().parameters) {
    if (parameter.name == name_of(messages::Parameter::output_interval_ms))
      answers_us = std::max(answers_us, 1e3 * parameter.value);
  }
  return {.age_limit_us = std::llround(checks::longest_wait_us(answers_us)), .end_us = scenario.duration_us};
}

}  // namespace

constinit const Estimator wind{
    .name = "wind", .layout = layout, .samples = samples_of, .freshness = freshness_of};

}  // namespace canhil::estimators
