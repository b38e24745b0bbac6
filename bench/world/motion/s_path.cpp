#include "bench/world/motion/s_path.hpp"

#include <cmath>
#include <numbers>

#include "bench/world/motion/course.hpp"

namespace canhil::world {

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

}  // namespace canhil::world
