#include "bench/world/motion/level_acceleration.hpp"

#include <algorithm>
#include <cmath>

namespace canhil::world {

Kinematics kinematics(const LevelAcceleration& motion, double t) {
  const double accelerating = t - 1e-6 * static_cast<double>(motion.cruise_us);  // [s]
  const Vector3 ahead(std::cos(motion.heading), std::sin(motion.heading), 0.0);
  Kinematics now;
  now.v_eb_n = (motion.speed + motion.acceleration * std::max(accelerating, 0.0)) * ahead;
  if (accelerating >= 0) now.v_eb_n_rate = motion.acceleration * ahead;
  now.angles.heading = motion.heading;
  return now;
}

}  // namespace canhil::world
