// The kinematics of a motion at one instant. The rest of the truth follows from them and from the Earth
// model.
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

/// Velocity and attitude with their derivatives, the attitude as a rotation matrix: the input of the truth.
struct Movement {
  Vector3 v_eb_n = Vector3::Zero();       ///< [m/s]
  Vector3 v_eb_n_rate = Vector3::Zero();  ///< derivative of the NED components [m/s^2]
  Matrix3 C_bn = Matrix3::Identity();
  Vector3 omega_nb_b = Vector3::Zero();  ///< [rad/s]
};

}  // namespace canhil::world
