// Straight legs joined by half turns to the right.
#pragma once

#include "bench/world/kinematics.hpp"
#include "bench/world/motion/depth_profile.hpp"

namespace canhil::world {

/// A leg, a half turn, a leg, ... The rate of a turn swells and ebbs, pi / turn (1 - cos(2 pi tau / turn)),
/// and so does the roll: acceleration and rate have no jumps.
struct Racetrack {
  double speed = 0;    ///< constant, along the nose [m/s]
  double heading = 0;  ///< of the first leg [rad]
  double leg = 1;      ///< time of a leg [s]
  double turn = 1;     ///< time of a half turn [s]
  double roll = 0;     ///< in the middle of a turn [rad]
  DepthProfile depth;
};

Kinematics kinematics(const Racetrack& motion, double t);

}  // namespace canhil::world
