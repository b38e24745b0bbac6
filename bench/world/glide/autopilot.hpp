// What moves the fins: an attitude hold and the lag of the actuators.
#pragma once

#include "bench/world/glide/aerodynamics.hpp"

namespace canhil::world::glide {

inline constexpr double fin_lag = 0.05;  // [s]

/// Commanded deflections that hold pitch and roll at zero and damp the yaw, within 20 degrees. A positive
/// elevator pitches down, a positive rudder yaws to the left, a positive aileron rolls to the right.
/// `pitch_integral`: of the pitch over time [rad s].
Fins commanded(const Euler& angles, const Vector3& omega, double pitch_integral);

}  // namespace canhil::world::glide
