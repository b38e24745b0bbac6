// At rest on the rotating Earth.
#pragma once

#include "bench/world/kinematics.hpp"

namespace canhil::world {

struct Rest {
  Euler angles;
};

inline Kinematics kinematics(const Rest& motion, double /*t*/) {
  Kinematics now;
  now.angles = motion.angles;
  return now;
}

}  // namespace canhil::world
