// What estimators of attitude and velocity have in common: what follows from their samples, and their tracks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/estimators/marks.hpp"
#include "bench/estimators/navigation.hpp"
#include "bench/quantities/list.hpp"
#include "bench/quantities/samples.hpp"
#include "bench/quantities/track.hpp"

namespace canhil::estimators {

/// The error of the heading over the sigma that the target tells.
inline double heading_over_its_sigma(const quantities::Samples& samples, std::size_t place) {
  return samples.value(place, quantities::attitude_heading) / samples.value(place, quantities::heading_sigma);
}
inline constexpr std::array alignment_derived{
    quantities::Derived{.quantity = &quantities::heading_over_sigma, .of = heading_over_its_sigma}};

/// What is particular of one of them.
struct AlignmentWords {
  quantities::Unit angle{};                                 ///< in which people read its angles
  std::string_view navigation_closes{};                     ///< the last message of its navigation answers
  std::array<const quantities::Quantity*, 3> innovation{};  ///< north, east, down
};

/// What AlignmentTracks gives of any of them, beside its innovations and statistics.
inline constexpr std::array<const quantities::Quantity*, 10> alignment_told{
    &quantities::attitude_heading,  &quantities::misalignment_north, &quantities::misalignment_east,
    &quantities::misalignment_down, &quantities::attitude_roll,      &quantities::attitude_pitch,
    &quantities::velocity_north,    &quantities::velocity_east,      &quantities::velocity_down,
    &quantities::velocity_norm};

/// These and what one of them tells alone.
template <std::size_t count>
constexpr auto and_alignment_told(const std::array<const quantities::Quantity*, count>& own) {
  std::array<const quantities::Quantity*, alignment_told.size() + count> all{};
  std::ranges::copy(own, std::ranges::copy(alignment_told, all.begin()).out);
  return all;
}

/// A normalised error squared after each update.
struct AlignmentStatistic {
  const quantities::Quantity* quantity = nullptr;
  std::string_view title{};
  std::vector<Normalised> series{};
  bool only_if_judged = false;
};

/// Gives attitude, velocity, innovations and normalised errors. `answers`: of the filter, with cause_us,
/// velocity_sigma and innovation; `misalignment_sigma(answer, axis)` [rad]; `filter_wait_us`: from one to the
/// next that is no silence; `unanswered`: of its tracks, see quantities::Track.
template <class Answers, class MisalignmentSigma>
class AlignmentTracks {
 public:
  AlignmentTracks(const AlignmentWords& words, const checks::Observations& seen,
                  const std::vector<NavigationAnswer>& navigation, const world::FlightRecord& flight,
                  std::int64_t duration_us, const Answers& answers, double filter_wait_us,
                  MisalignmentSigma misalignment_sigma,
                  std::function<std::string(std::int64_t, std::int64_t)> unanswered = {})
      : words_(words),
        navigation_(navigation),
        errors_(navigation_errors(navigation, flight)),
        answers_(answers),
        duration_us_(duration_us),
        navigation_wait_us_(
            checks::longest_wait_us(1e6 * checks::nominal_period_s(seen, words.navigation_closes))),
        filter_wait_us_(filter_wait_us),
        misalignment_sigma_(misalignment_sigma),
        unanswered_(std::move(unanswered)) {}

  [[nodiscard]] const std::vector<NavigationError>& errors() const { return errors_; }

  void give(const quantities::TrackSink& give, const std::vector<AlignmentStatistic>& statistics) const {
    using namespace quantities;
    give(heading());
    const std::array misalignment{&misalignment_north, &misalignment_east, &misalignment_down};
    for (int axis = 0; axis < 3; ++axis) {
      Track track = of(*misalignment[static_cast<std::size_t>(axis)], words_.angle,
                       std::string("attitude error about ") + axes[static_cast<std::size_t>(axis)]);
      fill(
          track, [=](const NavigationError& e) { return Told{.value = e.misalignment(axis)}; },
          [=, this](const auto& a) { return std::optional(misalignment_sigma_(a, axis)); });
      give(std::move(track));
    }
    // Sigmas of roll and pitch are not told: those of the tilts are.
    give(angle(attitude_roll, "roll error", &world::Euler::roll));
    give(angle(attitude_pitch, "pitch error", &world::Euler::pitch));
    const std::array velocity{&velocity_north, &velocity_east, &velocity_down};
    for (int axis = 0; axis < 3; ++axis) {
      Track track = of(*velocity[static_cast<std::size_t>(axis)], mps,
                       std::string("velocity error ") + axes[static_cast<std::size_t>(axis)]);
      fill(
          track,
          [=, this](const NavigationError& e) {
            const double told = answer_of(e).v_eb_n(axis);
            return Told{.value = e.v_eb_n(axis), .estimate = told, .truth = told - e.v_eb_n(axis)};
          },
          [=](const auto& a) { return std::optional(a.velocity_sigma(axis)); });
      give(std::move(track));
    }
    Track norm = of(velocity_norm, mps, "velocity error norm");
    norm.only_if_judged = true;
    fill(
        norm, [](const NavigationError& e) { return Told{.value = e.v_eb_n.norm()}; }, untold);
    give(std::move(norm));
    for (int axis = 0; axis < 3; ++axis) {
      const Quantity& quantity = *words_.innovation[static_cast<std::size_t>(axis)];
      Track track = of_filter(quantity, Track::Kind::innovation,
                              std::string("innovation ") + axes[static_cast<std::size_t>(axis)]);
      for (const auto& a : answers_) track.told.push_back({.t_us = a.cause_us, .value = a.innovation(axis)});
      give(std::move(track));
    }
    for (const AlignmentStatistic& one : statistics) {
      Track statistic = of_filter(*one.quantity, Track::Kind::statistic, std::string(one.title));
      statistic.only_if_judged = one.only_if_judged;
      for (const Normalised& n : one.series) statistic.told.push_back({.t_us = n.t_us, .value = n.value});
      give(std::move(statistic));
    }
  }

 private:
  static constexpr std::array axes{"north", "east", "down"};
  static constexpr auto untold = [](const auto&) { return std::optional<double>(); };

  [[nodiscard]] quantities::Track of(const quantities::Quantity& quantity, const quantities::Unit& unit,
                                     std::string title) const {
    return {.quantity = &quantity,
            .unit = unit,
            .title = std::move(title),
            .longest_wait_us = navigation_wait_us_,
            .answers_end_us = duration_us_};
  }
  [[nodiscard]] quantities::Track of_filter(const quantities::Quantity& quantity,
                                            quantities::Track::Kind kind, std::string title) const {
    quantities::Track track = of(quantity, quantity.unit, std::move(title));
    track.kind = kind;
    track.longest_wait_us = filter_wait_us_;
    track.unanswered = unanswered_;
    return track;
  }

  [[nodiscard]] const NavigationAnswer& answer_of(const NavigationError& error) const {
    return *std::ranges::lower_bound(navigation_, error.t_us, {}, &NavigationAnswer::cause_us);
  }

  // Errors with the sigma of the last filter answer before each, as long as that one is not stale.
  template <class Error, class Sigma>
  void fill(quantities::Track& track, Error error, Sigma sigma) const {
    auto next = answers_.begin();
    for (const NavigationError& e : errors_) {
      while (next != answers_.end() && next->cause_us <= e.t_us) ++next;
      quantities::Told told = error(e);
      told.t_us = e.t_us;
      if (next != answers_.begin()) {
        const auto& last = *std::prev(next);
        if (static_cast<double>(e.t_us - last.cause_us) <= filter_wait_us_) told.sigma = sigma(last);
      }
      track.told.push_back(told);
    }
  }

  [[nodiscard]] quantities::Track angle(const quantities::Quantity& quantity, std::string title,
                                        double world::Euler::*member) const {
    quantities::Track track = of(quantity, words_.angle, std::move(title));
    track.only_if_judged = true;
    fill(
        track,
        [=, this](const NavigationError& e) {
          const double told = answer_of(e).angles.*member;
          return quantities::Told{
              .value = e.angles.*member, .estimate = told, .truth = told - e.angles.*member};
        },
        untold);
    return track;
  }

  // Heading and its truth, without a jump where they pass south.
  [[nodiscard]] quantities::Track heading() const {
    quantities::Track track = of(quantities::attitude_heading, words_.angle, "heading error");
    track.only_if_judged = true;
    track.estimate_title = "heading";
    track.estimate_unit = quantities::degrees;
    double truth = 0;
    fill(
        track,
        [&](const NavigationError& e) {
          const double now = answer_of(e).angles.heading - e.angles.heading;
          truth += world::wrapped(now - truth);
          return quantities::Told{
              .value = e.angles.heading, .estimate = truth + e.angles.heading, .truth = truth};
        },
        [this](const auto& a) { return std::optional(misalignment_sigma_(a, 2)); });
    return track;
  }

  const AlignmentWords& words_;
  const std::vector<NavigationAnswer>& navigation_;
  std::vector<NavigationError> errors_;
  const Answers& answers_;
  std::int64_t duration_us_;
  double navigation_wait_us_;
  double filter_wait_us_;
  MisalignmentSigma misalignment_sigma_;
  std::function<std::string(std::int64_t, std::int64_t)> unanswered_;  // of the filter: see Track
};

}  // namespace canhil::estimators
