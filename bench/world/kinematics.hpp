// What a motion says of one instant. Everything else of the truth follows from it and from the Earth.
#pragma once

#include "bench/world/attitude.hpp"

namespace canhil::world {

/// Velocity and attitude with their derivatives, w.r.t. local NED axes.
struct Kinematics {
  Vector3 v_eb_n = Vector3::Zero();       ///< [m/s]
  Vector3 v_eb_n_rate = Vector3::Zero();  ///< derivative of the NED components [m/s^2]
  Euler angles;                           ///< [rad]
  Euler rates;                            ///< [rad/s]
};

}  // namespace canhil::world
