// A flight of which only the start is known. As a placeholder, the motion continues straight on. This motion
// must not be used to compute errors.
#pragma once

#include "bench/world/kinematics.hpp"

namespace canhil::world {

struct Unknown {
  Vector3 v_eb_n = Vector3::Zero();  ///< at the start [m/s]
  Euler angles;                      ///< at the start [rad]
};

inline Kinematics kinematics(const Unknown& motion, double /*t*/) {
  Kinematics now;
  now.v_eb_n = motion.v_eb_n;
  now.angles = motion.angles;
  return now;
}

}  // namespace canhil::world
