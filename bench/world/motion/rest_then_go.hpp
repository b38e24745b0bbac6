// At rest for a while, then to a constant speed along the nose.
#pragma once

#include "bench/world/kinematics.hpp"
#include "bench/world/motion/depth_profile.hpp"

namespace canhil::world {

/// The acceleration swells and ebbs, speed / start (1 - cos(2 pi tau / start)): it has no jumps. The dive
/// begins with it.
struct RestThenGo {
  double speed = 0;    ///< in the end [m/s]
  double heading = 0;  ///< [rad]
  double rest = 0;     ///< time at rest [s]
  double start = 1;    ///< time to the speed [s]
  DepthProfile depth;
};

Kinematics kinematics(const RestThenGo& motion, double t);

}  // namespace canhil::world
