#include "bench/world/motion/along_the_nose.hpp"

#include <cmath>
#include <numbers>

namespace canhil::world {
namespace {

/// Speed and attitude at one instant, with their derivatives.
struct Course {
  double speed = 0;       ///< along body x [m/s]
  double speed_rate = 0;  ///< [m/s^2]
  Euler angles;
  Euler rates;
};

/// v_eb_n = speed C_bn (1, 0, 0), and its derivative.
Kinematics kinematics(const Course& course) {
  const double sh = std::sin(course.angles.heading);
  const double ch = std::cos(course.angles.heading);
  const double sp = std::sin(course.angles.pitch);
  const double cp = std::cos(course.angles.pitch);
  const Vector3 ahead(cp * ch, cp * sh, -sp);
  const Vector3 ahead_rate = course.rates.pitch * Vector3(-sp * ch, -sp * sh, -cp) +
                             course.rates.heading * Vector3(-cp * sh, cp * ch, 0);
  return {.v_eb_n = course.speed * ahead,
          .v_eb_n_rate = course.speed_rate * ahead + course.speed * ahead_rate,
          .angles = course.angles,
          .rates = course.rates};
}

/// Pitch with its derivative.
struct Dive {
  double pitch = 0;  ///< [rad]
  double rate = 0;   ///< [rad/s]
};

/// The pitch at which a vehicle with a given speed along its nose follows the profile. The sine of the pitch
/// is -(d depth / dt) / speed. `speed` must exceed steepest(profile).
Dive dive(const DepthProfile& profile, double speed, double t) {
  if (profile.depth == 0) return {};
  const double w = 2.0 * std::numbers::pi / profile.period;
  const double slope = steepest(profile) / speed;
  const double sine = -slope * std::sin(w * t);
  return {.pitch = std::asin(sine), .rate = -slope * w * std::cos(w * t) / std::sqrt(1.0 - sine * sine)};
}

}  // namespace

double steepest(const DepthProfile& profile) { return std::numbers::pi * profile.depth / profile.period; }

Kinematics kinematics(const SPath& motion, double t) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const double w_heading = turn / motion.heading_period;
  const double w_pitch = turn / motion.pitch_period;
  const double w_roll = turn / motion.roll_period;
  const Dive diving = dive(motion.depth, motion.speed, t);
  return kinematics(
      Course{.speed = motion.speed,
             .speed_rate = 0,
             .angles = {.roll = motion.roll_amplitude * std::cos(w_roll * t),
                        .pitch = diving.pitch + motion.pitch_amplitude * std::sin(w_pitch * t),
                        .heading = motion.heading + motion.heading_amplitude * std::sin(w_heading * t)},
             .rates = {.roll = -motion.roll_amplitude * w_roll * std::sin(w_roll * t),
                       .pitch = diving.rate + motion.pitch_amplitude * w_pitch * std::cos(w_pitch * t),
                       .heading = motion.heading_amplitude * w_heading * std::cos(w_heading * t)}});
}

Kinematics kinematics(const Racetrack& motion, double t) {
  constexpr double pi = std::numbers::pi;
  const double half = motion.leg + motion.turn;
  const double turns = std::floor(t / half);  // completed turns
  const double tau = t - turns * half - motion.leg;
  const double w = 2.0 * pi / motion.turn;
  const Dive diving = dive(motion.depth, motion.speed, t);
  Course course{.speed = motion.speed,
                .speed_rate = 0,
                .angles = {.roll = 0, .pitch = diving.pitch, .heading = motion.heading + pi * turns},
                .rates = {.roll = 0, .pitch = diving.rate, .heading = 0}};
  if (tau > 0) {
    const double swell = 1.0 - std::cos(w * tau);
    course.angles.heading += pi / motion.turn * (tau - std::sin(w * tau) / w);
    course.rates.heading = pi / motion.turn * swell;
    course.angles.roll = 0.5 * motion.roll * swell;
    course.rates.roll = 0.5 * motion.roll * w * std::sin(w * tau);
  }
  return kinematics(course);
}

Kinematics kinematics(const Spiral& motion, double t) {
  const double rate = 2.0 * std::numbers::pi / motion.period;
  const Dive diving = dive(motion.depth, motion.speed, t);
  return kinematics(
      Course{.speed = motion.speed,
             .speed_rate = 0,
             .angles = {.roll = motion.roll, .pitch = diving.pitch, .heading = motion.heading + rate * t},
             .rates = {.roll = 0, .pitch = diving.rate, .heading = rate}});
}

Kinematics kinematics(const RestThenGo& motion, double t) {
  const double tau = t - motion.rest;
  Course course{.speed = motion.speed,
                .speed_rate = 0,
                .angles = {.roll = 0, .pitch = 0, .heading = motion.heading},
                .rates = {}};
  if (tau <= 0) {
    course.speed = 0;
    return kinematics(course);
  }
  const Dive diving = dive(motion.depth, motion.speed, tau);
  course.angles.pitch = diving.pitch;
  course.rates.pitch = diving.rate;
  if (tau < motion.start) {
    const double w = 2.0 * std::numbers::pi / motion.start;
    course.speed *= (tau - std::sin(w * tau) / w) / motion.start;
    course.speed_rate = motion.speed / motion.start * (1.0 - std::cos(w * tau));
  }
  return kinematics(course);
}

}  // namespace canhil::world
