#include "bench/world/motion/rest_then_go.hpp"

#include <cmath>
#include <numbers>

#include "bench/world/motion/course.hpp"

namespace canhil::world {

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
