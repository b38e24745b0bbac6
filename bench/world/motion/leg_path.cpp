#include "bench/world/motion/leg_path.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bench/world/motion/legs.hpp"
#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

double in_seconds(std::int64_t t_us) { return 1e-6 * static_cast<double>(t_us); }

/// The heading during a turn that begins at tau = 0: its rate rises within `transition`, is constant, and
/// falls within `transition`, so that the whole angle is turned within `time` [s].
Changing heading_in_turn(double before, double angle, double time, double transition, double tau) {
  if (tau >= time || angle == 0) return {.value = before + angle};
  const double rate = angle / (time - transition);
  if (tau < transition) {
    const Changing rising = blend(0, rate, transition, tau);
    return {before + rate * blend_integral(transition, tau), rising.value, rising.rate};
  }
  if (tau > time - transition) {
    const Changing falling = blend(rate, 0, transition, tau - (time - transition));
    return {before + angle - rate * blend_integral(transition, time - tau), falling.value, falling.rate};
  }
  return {before + rate * (tau - 0.5 * transition), rate, 0};
}

/// Roll and pitch of a rotorcraft whose heading is `heading`, with their rates, from the horizontal velocity
/// along the course and the climb rate. The thrust is along -z of the body and equals the specific force,
/// without drag and Earth rotation.
Kinematics tilted(const Changing& speed, const Changing& climb_rate, const Changing& course,
                  const Changing& drift, const Changing& heading) {
  const double sc = std::sin(course.value), cc = std::cos(course.value);
  // Acceleration along and across the course, with its derivative.
  const double along = speed.rate, along_rate = speed.rate_rate;
  const double across = speed.value * course.rate;
  const double across_rate = speed.rate * course.rate + speed.value * course.rate_rate;
  // The same vector in axes forward and right of the nose. The rates are those of the components.
  const double sd = std::sin(drift.value), cd = std::cos(drift.value);
  const double forward = along * cd - across * sd;
  const double right = along * sd + across * cd;
  const double forward_rate = along_rate * cd - across_rate * sd - right * drift.rate;
  const double right_rate = along_rate * sd + across_rate * cd + forward * drift.rate;
  // The thrust upwards, and in the vertical plane through the nose [m/s^2].
  const double up = units::standard_gravity + climb_rate.rate, up_rate = climb_rate.rate_rate;
  const double in_plane = std::hypot(forward, up);
  const double in_plane_rate = (forward * forward_rate + up * up_rate) / in_plane;
  return {.v_eb_n = {speed.value * cc, speed.value * sc, -climb_rate.value},
          .v_eb_n_rate = {along * cc - across * sc, along * sc + across * cc, -climb_rate.rate},
          .angles = {.roll = std::atan2(right, in_plane),
                     .pitch = std::atan2(0.0 - forward, up),
                     .heading = heading.value},
          .rates = {
              .roll = (right_rate * in_plane - right * in_plane_rate) / (right * right + in_plane * in_plane),
              .pitch = -(forward_rate * up - forward * up_rate) / (in_plane * in_plane),
              .heading = heading.rate}};
}

}  // namespace

LegPath::LegPath(const Carrier& carrier, double speed, double heading, std::span<const Leg> legs)
    : carrier_(carrier) {
  Stretch next{.speed_before = speed, .heading_before = heading, .speed = speed};
  std::int64_t from_us = 0;
  for (const Leg& leg : legs) {
    const std::int64_t ends_us = std::min(leg.transition_us, leg.turn_us / 2);
    assert(leg.turn == 0 || ends_us > 0);
    next.speed = leg.speed;
    next.climb = leg.climb;
    next.drift = leg.drift;
    next.turn = leg.turn;
    next.speed_time = in_seconds(leg.speed_us);
    next.transition = in_seconds(leg.transition_us);
    next.turn_time = in_seconds(leg.turn_us);
    next.turn_transition = in_seconds(ends_us);
    stretches_.push_back(next);
    if (leg.speed != next.speed_before) add_blend(from_us, leg.speed_us);
    if (leg.climb != next.climb_before || leg.drift != next.drift_before)
      add_blend(from_us, leg.transition_us);
    if (leg.turn != 0) {
      add_blend(from_us, ends_us);
      add_blend(from_us + leg.turn_us - ends_us, ends_us);
    }
    from_us += leg.duration_us;
    next.from = in_seconds(from_us);
    next.speed_before = leg.speed;
    next.climb_before = leg.climb;
    next.drift_before = leg.drift;
    next.heading_before += leg.turn;
  }
  // After the last leg, the last values are held.
  next.speed = next.speed_before;
  next.climb = next.climb_before;
  next.drift = next.drift_before;
  next.turn = 0;
  stretches_.push_back(next);
  std::ranges::sort(jumps_us_);
  jumps_us_.erase(std::unique(jumps_us_.begin(), jumps_us_.end()), jumps_us_.end());
}

// The polynomials of two blends multiply each other, and the sine of a third. A rule with five nodes
// integrates an eighth of a blend to rounding.
void LegPath::add_blend(std::int64_t from_us, std::int64_t length_us) {
  constexpr int pieces = 8;
  for (int piece = 0; piece <= pieces; ++piece) jumps_us_.push_back(from_us + piece * length_us / pieces);
}

LegPath::Course LegPath::course(const Stretch& stretch, double tau) {
  Course now{.speed = blend(stretch.speed_before, stretch.speed, stretch.speed_time, tau),
             .climb = blend(stretch.climb_before, stretch.climb, stretch.transition, tau),
             .drift = {.value = stretch.drift},
             .heading = heading_in_turn(stretch.heading_before, stretch.turn, stretch.turn_time,
                                        stretch.turn_transition, tau)};
  if (stretch.drift == stretch.drift_before) return now;
  if (stretch.turn == 0) {
    now.drift = blend(stretch.drift_before, stretch.drift, stretch.transition, tau);
  } else {
    // In proportion to the turn. So a turn to the right together with an equal drift to the left is a turn of
    // the nose alone, on a straight course.
    const double by_turn = (stretch.drift - stretch.drift_before) / stretch.turn;
    now.drift = {stretch.drift_before + by_turn * (now.heading.value - stretch.heading_before),
                 by_turn * now.heading.rate, by_turn * now.heading.rate_rate};
  }
  return now;
}

Kinematics LegPath::along_the_path(const Course& now) const {
  const auto& [speed, climb, drift, heading] = now;
  const double sh = std::sin(heading.value), ch = std::cos(heading.value);
  const double sc = std::sin(climb.value), cc = std::cos(climb.value);
  const Vector3 ahead(cc * ch, cc * sh, -sc);
  const Vector3 ahead_rate =
      climb.rate * Vector3(-sc * ch, -sc * sh, -cc) + heading.rate * Vector3(-cc * sh, cc * ch, 0);
  Kinematics kinematics{.v_eb_n = speed.value * ahead,
                        .v_eb_n_rate = speed.rate * ahead + speed.value * ahead_rate,
                        .angles = {.roll = 0, .pitch = climb.value, .heading = heading.value},
                        .rates = {.roll = 0, .pitch = climb.rate, .heading = heading.rate}};
  const double lateral = speed.value * cc * heading.rate;  // acceleration to the right [m/s^2]
  const double lateral_rate =
      (speed.rate * cc - speed.value * sc * climb.rate) * heading.rate + speed.value * cc * heading.rate_rate;
  if (carrier_.vehicle == Vehicle::aircraft) {
    const double slope = lateral / units::standard_gravity;
    kinematics.angles.roll = std::atan(slope);
    kinematics.rates.roll = lateral_rate / units::standard_gravity / (1 + slope * slope);
    kinematics.angles.pitch += carrier_.angle_of_attack;
  } else {
    kinematics.angles.roll = -carrier_.roll_by_acceleration * lateral;
    kinematics.rates.roll = -carrier_.roll_by_acceleration * lateral_rate;
  }
  return kinematics;
}

Kinematics LegPath::kinematics(double t) const {
  const auto after =
      std::upper_bound(stretches_.begin() + 1, stretches_.end(), t,
                       [](double time, const Stretch& stretch) { return time < stretch.from; });
  const Stretch& stretch = *(after - 1);
  const Course now = course(stretch, t - stretch.from);
  if (carrier_.vehicle != Vehicle::rotorcraft) return along_the_path(now);
  const auto& [speed, climb_rate, drift, heading] = now;
  const Changing over_ground{heading.value + drift.value, heading.rate + drift.rate,
                             heading.rate_rate + drift.rate_rate};
  return tilted(speed, climb_rate, over_ground, drift, heading);
}

Kinematics kinematics(const Legs& motion, double t) { return motion.path->kinematics(t); }

}  // namespace canhil::world
