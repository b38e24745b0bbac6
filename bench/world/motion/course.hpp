// A vehicle that moves along its nose: velocity follows from speed and attitude.
#pragma once

#include "bench/world/kinematics.hpp"

namespace canhil::world {

/// Speed and attitude at one instant, with their derivatives.
struct Course {
  double speed = 0;       ///< along body x [m/s]
  double speed_rate = 0;  ///< [m/s^2]
  Euler angles;
  Euler rates;
};

/// v_eb_n = speed C_bn (1, 0, 0), and its derivative.
Kinematics kinematics(const Course& course);

}  // namespace canhil::world
