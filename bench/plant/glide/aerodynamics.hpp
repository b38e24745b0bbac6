// The glider: a 500-lb body with a planar wing kit. The data are not those of a real weapon: the body has the
// size of the Mk-82 class, and all coefficients are textbook estimates.
//
// Lift and drag act in stability axes, the side force acts along body y, and the moments act about the centre
// of gravity. These are eq. (7) and (8) of Park and Park (2019) with two corrections: the paper mixes
// stability axes with wind axes, and assigns a moment to gravity.
#pragma once

#include <array>
#include <cstdint>

#include "bench/plant/glide/atmosphere.hpp"
#include "bench/world/attitude.hpp"

namespace canhil::plant::glide {

using world::Matrix3;
using world::Vector3;

inline constexpr double mass = 300;  // [kg]

/// Inertia about the centre of gravity, body axes [kg m^2].
Matrix3 inertia();

/// Deflections of elevator, aileron and rudder [rad].
using Fins = Vector3;

enum class Coefficient : std::uint8_t { lift, drag, side, roll, pitch, yaw };
inline constexpr std::size_t coefficient_count = 6;
/// The summands of a coefficient.
enum class Part : std::uint8_t { steady, rate, control };
inline constexpr std::size_t part_count = 3;

/// The ratio of true to nominal value, for each part of each coefficient.
using Factors = std::array<std::array<double, part_count>, coefficient_count>;
inline constexpr Factors nominal{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};

/// Direction and speed of the air flow.
struct Flow {
  double speed = 0;  ///< V = |v_a| [m/s]
  double alpha = 0;  ///< atan2(w, u) [rad]
  double beta = 0;   ///< asin(v / V) [rad]
  double mach = 0;
};
Flow flow(const Vector3& v_a, double speed_of_sound);

/// The coefficients of lift, drag and side force, and of the rolling, pitching and yawing moment. omega is in
/// rad/s.
std::array<double, coefficient_count> coefficients(const Flow& flow, const Vector3& omega, const Fins& fins,
                                                   const Factors& factors = nominal);

/// Aerodynamic force and moment on the glider, body axes.
struct Loads {
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< about the centre of gravity [N m]
};
/// v_a: velocity through the air, body axes [m/s].
Loads loads(const Vector3& v_a, const Vector3& omega, const Fins& fins, const Air& air,
            const Factors& factors = nominal);

}  // namespace canhil::plant::glide
