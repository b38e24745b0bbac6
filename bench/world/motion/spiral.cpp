#include "bench/world/motion/spiral.hpp"

#include <numbers>

#include "bench/world/motion/course.hpp"

namespace canhil::world {

Kinematics kinematics(const Spiral& motion, double t) {
  const double rate = 2.0 * std::numbers::pi / motion.period;
  const Dive diving = dive(motion.depth, motion.speed, t);
  return kinematics(
      Course{.speed = motion.speed,
             .speed_rate = 0,
             .angles = {.roll = motion.roll, .pitch = diving.pitch, .heading = motion.heading + rate * t},
             .rates = {.roll = 0, .pitch = diving.rate, .heading = rate}});
}

}  // namespace canhil::world
