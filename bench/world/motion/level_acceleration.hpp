// The flight of Yang, Shim, Park (2001): level at constant velocity, then a constant acceleration along the
// heading.
#pragma once

#include <cstdint>

#include "bench/world/kinematics.hpp"

namespace canhil::world {

struct LevelAcceleration {
  double heading = 0;          ///< [rad]
  double speed = 0;            ///< at the start [m/s]
  std::int64_t cruise_us = 0;  ///< time at which the acceleration begins
  double acceleration = 0;     ///< [m/s^2]
};

Kinematics kinematics(const LevelAcceleration& motion, double t);

}  // namespace canhil::world
