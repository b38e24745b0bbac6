#include "bench/estimators/wind/wind.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"
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

constexpr std::array<const Quantity*, 2> of_runs_alone{&wind_north, &wind_east};

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

void tracks_of(const checks::Observations& seen, const Truth& truth, const TrackSink& give) {
  if (truth.glide == nullptr) return;
  const auto errors = checks::wind_errors(seen, *truth.glide);
  const double wait_us =
      checks::longest_wait_us(1e6 * checks::nominal_period_s(seen, messages::WindUpdate::info.name));
  const auto empty = [&](const Quantity& quantity, std::string title) {
    return Track{.quantity = &quantity,
                 .unit = mps,
                 .title = std::move(title),
                 .longest_wait_us = wait_us,
                 .answers_end_us = truth.glide->end_us()};
  };
  const auto fill = [&](Track track, auto told) {
    for (const checks::WindError& e : errors) {
      track.told.push_back(
          told(*std::ranges::lower_bound(seen.wind, e.t_us, {}, &checks::WindAnswer::cause_us), e));
      track.told.back().t_us = e.t_us;
    }
    give(std::move(track));
  };
  const std::array ned{std::pair{&wind_north, "north"}, std::pair{&wind_east, "east"},
                       std::pair{&wind_down, "down"}};
  for (int axis = 0; axis < 3; ++axis) {
    const auto& [quantity, name] = ned[static_cast<std::size_t>(axis)];
    Track track = empty(*quantity, std::string("wind error ") + name);
    track.estimate_title = std::string("wind ") + name;
    track.estimate_unit = mps;
    fill(std::move(track), [=](const checks::WindAnswer& answer, const checks::WindError& e) {
      const double estimate = answer.wind_n(axis);
      return Told{.value = e.error_n(axis),
                  .sigma = answer.sigma(axis),
                  .estimate = estimate,
                  .truth = estimate - e.error_n(axis)};
    });
  }
  const auto judged = [&](const Quantity& quantity, std::string title) {
    Track track = empty(quantity, std::move(title));
    track.only_if_judged = true;
    return track;
  };
  fill(judged(wind_along, "wind error along track"), [](const auto& answer, const checks::WindError& e) {
    return Told{.value = e.along_track, .sigma = answer.along_track_sigma};
  });
  fill(judged(wind_cross, "wind error cross track"), [](const auto& answer, const checks::WindError& e) {
    return Told{.value = e.cross_track, .sigma = answer.cross_track_sigma};
  });
  fill(judged(wind_norm, "wind error norm"),
       [](const auto&, const checks::WindError& e) { return Told{.value = e.error_n.norm()}; });
  Track statistic = empty(wind_nis, "normalised innovation squared");
  statistic.kind = Track::Kind::statistic;
  statistic.unit = plain;
  for (const checks::Normalised& n : checks::wind_nis(seen))
    statistic.told.push_back({.t_us = n.t_us, .value = n.value});
  give(std::move(statistic));
}

// The filter may answer less often than it is told of the navigation.
Freshness freshness_of(const scenario::Scenario& scenario) {
  const scenario::NodeSettings* navigation = scenario.node("glider_nav");
  if (navigation == nullptr) return {};
  double answers_us = period_us(*navigation);
  for (const scenario::Parameter& parameter : scenario.targets.front().parameters) {
    if (parameter.name == name_of(messages::Parameter::output_interval_ms))
      answers_us = std::max(answers_us, 1e3 * parameter.value);
  }
  return {.age_limit_us = std::llround(checks::longest_wait_us(answers_us)), .end_us = scenario.duration_us};
}

}  // namespace

constinit const Estimator wind{.name = "wind",
                               .layout = layout,
                               .of_runs_alone = of_runs_alone,
                               .samples = samples_of,
                               .tracks = tracks_of,
                               .freshness = freshness_of};

}  // namespace canhil::estimators
