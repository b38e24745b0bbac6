#include "bench/world/motion/weave.hpp"

#include <cmath>
#include <numbers>

#include "bench/world/units.hpp"

namespace canhil::world {

Kinematics kinematics(const Weave& motion, double t) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const double w = turn / motion.turn_period;
  const double w_pitch = turn / motion.pitch_period;
  const double w_cone = turn / motion.coning_period;

  // The speed along the path is constant. The heading is heading_0 + A (1 - cos(w t)). The climb angle is P
  // sin(w_pitch t).
  const double heading = motion.heading + motion.heading_amplitude * (1.0 - std::cos(w * t));
  const double heading_rate = motion.heading_amplitude * w * std::sin(w * t);
  const double heading_rate_rate = motion.heading_amplitude * w * w * std::cos(w * t);
  const double climb = motion.pitch_amplitude * std::sin(w_pitch * t);
  const double climb_rate = motion.pitch_amplitude * w_pitch * std::cos(w_pitch * t);
  const double sh = std::sin(heading);
  const double ch = std::cos(heading);
  const double sc = std::sin(climb);
  const double cc = std::cos(climb);

  // A coordinated turn: tan(roll) is speed times heading rate times cos(climb) / g, so the lateral specific
  // force is almost zero.
  const double slope = motion.speed * heading_rate * cc / units::standard_gravity;
  const double slope_rate =
      motion.speed * (heading_rate_rate * cc - heading_rate * sc * climb_rate) / units::standard_gravity;

  // The cone: pitch and heading vibrate with a phase difference of 90 deg, so body x describes a cone about
  // the path.
  const double c = motion.coning_amplitude;
  Kinematics now;
  now.v_eb_n = motion.speed * Vector3(cc * ch, cc * sh, -sc);
  now.v_eb_n_rate = motion.speed * Vector3(-sc * ch * climb_rate - cc * sh * heading_rate,
                                           -sc * sh * climb_rate + cc * ch * heading_rate, -cc * climb_rate);
  now.angles = {.roll = std::atan(slope),
                .pitch = climb + c * std::sin(w_cone * t),
                .heading = heading + c * std::cos(w_cone * t)};
  now.rates = {.roll = slope_rate / (1.0 + slope * slope),
               .pitch = climb_rate + c * w_cone * std::cos(w_cone * t),
               .heading = heading_rate - c * w_cone * std::sin(w_cone * t)};
  return now;
}

}  // namespace canhil::world
