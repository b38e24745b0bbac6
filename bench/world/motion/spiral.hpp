// Circling at a constant rate: a helix with a depth profile.
#pragma once

#include "bench/world/kinematics.hpp"
#include "bench/world/motion/depth_profile.hpp"

namespace canhil::world {

struct Spiral {
  double speed = 0;    ///< constant, along the nose [m/s]
  double heading = 0;  ///< at the start [rad]
  double period = 1;   ///< of a full turn to the right [s]
  double roll = 0;     ///< constant [rad]
  DepthProfile depth;
};

Kinematics kinematics(const Spiral& motion, double t);

}  // namespace canhil::world
