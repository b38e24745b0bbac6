// Building blocks shared by the estimators of attitude and velocity: derived quantities, tracks and result
// lines.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/checks/results.hpp"
#include "bench/estimators/marks.hpp"
#include "bench/estimators/navigation.hpp"
#include "bench/estimators/tracks.hpp"
#include "bench/quantities/list.hpp"
#include "bench/quantities/samples.hpp"
#include "bench/quantities/unwrapped.hpp"

namespace canhil::estimators {

/// The heading error divided by the sigma that the target reports.
inline double heading_over_its_sigma(const quantities::Samples& samples, std::size_t index) {
  return samples.value(index, quantities::attitude_heading) / samples.value(index, quantities::heading_sigma);
}
inline constexpr std::array alignment_derived{
    quantities::Derived{.quantity = &quantities::heading_over_sigma, .of = heading_over_its_sigma}};

/// The quantities of the tracks that give_alignment() creates for every estimator, except the innovations.
inline constexpr std::array<const quantities::Quantity*, 10> alignment_reported{
    &quantities::attitude_heading,  &quantities::misalignment_north, &quantities::misalignment_east,
    &quantities::misalignment_down, &quantities::attitude_roll,      &quantities::attitude_pitch,
    &quantities::velocity_north,    &quantities::velocity_east,      &quantities::velocity_down,
    &quantities::velocity_norm};

/// A list of quantities: first those of alignment_reported, then those of `own`, which only one estimator
/// reports.
template <std::size_t count>
constexpr auto and_alignment_reported(const std::array<const quantities::Quantity*, count>& own) {
  std::array<const quantities::Quantity*, alignment_reported.size() + count> all{};
  std::ranges::copy(own, std::ranges::copy(alignment_reported, all.begin()).out);
  return all;
}

/// The inputs of give_alignment(): the answers of one estimator and the properties of its tracks.
struct Alignment {
  const quantities::Unit& angle;                            ///< unit of angles in reports
  std::array<const quantities::Quantity*, 3> innovation{};  ///< north, east, down
  const InOrderOfCause<NavigationAnswer>& navigation;
  const Spool<NavigationError>& errors;  ///< errors of `navigation`
  Answering navigates;
  Answering filters;
};

/// False for the answer of a filter that has only predicted; it has no innovation.
constexpr bool answers_measurement(const auto& answer) {
  if constexpr (requires { answer.outcome; }) return answer.outcome != messages::FixOutcome::predicted;
  return true;
}

/// Creates the tracks of attitude, velocity and innovations. `filter`: the answers of the filter; each answer
/// has the members cause_us, attitude_sigma, velocity_sigma and innovation.
template <class Answers>
void give_alignment(const Alignment& of, const Answers& filter, const quantities::TrackSink& give) {
  using namespace quantities;
  // Each error gets the sigma of the last filter answer at or before the time of the error. If that answer is
  // stale, the error gets no sigma.
  const auto fill = [&](Track track, auto error, auto sigma) {
    auto next = filter.begin();
    for (const NavigationError& e : of.errors) {
      while (next != filter.end() && next->cause_us <= e.t_us) ++next;
      TrackPoint point = error(e, of.navigation[e.answer]);
      point.t_us = e.t_us;
      if (next != filter.begin()) {
        const auto& last = *std::prev(next);
        if (static_cast<double>(e.t_us - last.cause_us) <= of.filters.longest_wait_us)
          point.sigma = sigma(last);
      }
      track.points.push_back(point);
    }
    give(std::move(track));
  };
  const auto no_sigma = [](const auto&) { return std::optional<double>(); };
  const auto angle = [&](const Quantity& quantity, std::string title) {
    Track track = of.navigates.track(quantity, std::move(title));
    track.unit = of.angle;
    return track;
  };

  // The estimated and the true angle, unwrapped where they pass 180 deg.
  const auto unwrapped_angle = [](double world::Euler::*member) {
    return [member, last_truth = 0.0](const NavigationError& e, const NavigationAnswer& answer) mutable {
      const double error = e.angles.*member, truth = unwrapped(answer.angles.*member - error, last_truth);
      if (std::isfinite(truth)) last_truth = truth;
      return TrackPoint{.value = error, .estimate = unwrapped(answer.angles.*member, truth), .truth = truth};
    };
  };
  Track heading = judged(angle(attitude_heading, "heading error"));
  heading.estimate_title = "heading";
  heading.estimate_unit = degrees;
  fill(std::move(heading), unwrapped_angle(&world::Euler::heading),
       [](const auto& a) { return a.attitude_sigma.z(); });
  each_axis(
      {&misalignment_north, &misalignment_east, &misalignment_down},
      [&](const Quantity& quantity, const std::string& name, int axis) {
        fill(
            angle(quantity, "attitude error about " + name),
            [=](const NavigationError& e, const auto&) { return TrackPoint{.value = e.misalignment(axis)}; },
            [=](const auto& a) { return a.attitude_sigma(axis); });
      });
  // The target reports sigmas of the tilts, not of roll and pitch.
  const auto give_angle = [&](const Quantity& quantity, std::string title, double world::Euler::*member) {
    fill(judged(angle(quantity, std::move(title))), unwrapped_angle(member), no_sigma);
  };
  give_angle(attitude_roll, "roll error", &world::Euler::roll);
  give_angle(attitude_pitch, "pitch error", &world::Euler::pitch);
  each_axis({&velocity_north, &velocity_east, &velocity_down},
            [&](const Quantity& quantity, const std::string& name, int axis) {
              fill(
                  of.navigates.track(quantity, "velocity error " + name),
                  [=](const NavigationError& e, const NavigationAnswer& answer) {
                    const double estimate = answer.v_eb_n(axis);
                    return TrackPoint{
                        .value = e.v_eb_n(axis), .estimate = estimate, .truth = estimate - e.v_eb_n(axis)};
                  },
                  [=](const auto& a) { return a.velocity_sigma(axis); });
            });
  fill(
      judged(of.navigates.track(velocity_norm, "velocity error norm")),
      [](const NavigationError& e, const auto&) { return TrackPoint{.value = e.v_eb_n.norm()}; }, no_sigma);
  each_axis(of.innovation, [&](const Quantity& quantity, const std::string& name, int axis) {
    Track track = of.filters.track(quantity, "innovation " + name);
    track.kind = Track::Kind::innovation;
    for (const auto& a : filter) {
      if (!answers_measurement(a)) continue;
      track.points.push_back({.t_us = a.cause_us, .value = a.innovation(axis)});
    }
    give(std::move(track));
  });
}

/// Two result lines. The first line gives, for each band, the time from which the heading error stays within
/// the band. The second line gives the errors of the last answer. `angle`: the unit of the bands, and of the
/// angles in the result.
std::vector<ResultLine> alignment_results(const Spool<NavigationError>& errors, std::span<const double> bands,
                                          const quantities::Unit& angle);

}  // namespace canhil::estimators
