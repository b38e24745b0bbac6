#include "bench/world/motion/racetrack.hpp"

#include <cmath>
#include <numbers>

#include "bench/world/motion/course.hpp"

namespace canhil::world {

Kinematics kinematics(const Racetrack& motion, double t) {
  constexpr double pi = std::numbers::pi;
  const double half = motion.leg + motion.turn;
  const double turns = std::floor(t / half);  // whole ones before
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

}  // namespace canhil::world
