// A flight of which nothing is known but its start. What follows is straight on and stands for nothing: no
// error may be judged by it.
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
