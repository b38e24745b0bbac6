#pragma once
// Aerodynamic force and moment from the table. Lift and drag are in stability axes, the side force is along
// body y (Park and Park 2019, eq. (7); corrected: the paper mixes stability and wind axes, and its
// S sin(beta) has the wrong sign).
#include <Eigen/Core>

#include "target/estimators/wind/airframe.hpp"
#include "target/estimators/wind/atmosphere.hpp"

namespace canhil::wind {

/// One flag for each quantity: true if the quantity is outside the model's range.
struct RangeFlags {
  bool alpha = false, beta = false, speed = false, mach = false, altitude = false, pitch = false;
  /// True if any quantity is outside.
  bool any() const { return alpha || beta || speed || mach || altitude || pitch; }
  RangeFlags& operator|=(const RangeFlags& other);
  bool operator==(const RangeFlags&) const = default;
};

/// The air flow relative to the body. Its values are clamped to the range of the table; they select the
/// coefficients.
struct Flow {
  double speed = 0, alpha = 0, beta = 0, mach = 0;  // V = |v_a|, atan2(w, u), asin(v/V), V/a
  double sin_alpha = 0, cos_alpha = 1;
  double compressibility = 1;
  Eigen::Vector3d rates;  // p b/2V, q c/2V, r b/2V
  RangeFlags outside;
};

/// Lift, drag and side force; rolling, pitching and yawing moment.
struct Coefficients {
  double lift = 0, drag = 0, side = 0, roll = 0, pitch = 0, yaw = 0;
};

/// Force per unit mass [m/s^2] and moment about the centre of gravity [N m], body axes.
struct Loads {
  Eigen::Vector3d specific_force, moment;
};

/// Each coefficient (lift, drag, side; roll, pitch, yaw) is the sum of three parts: flow, fins, rates.
inline constexpr int force_part_count = 9;  ///< the parts of lift, drag and side force
inline constexpr int part_count = 18;       ///< all parts

/// The contribution of each part to the specific force [m/s^2] and to the moment [N m], body axes, beginning
/// with the parts of lift. The sums over all parts equal loads(). The induced drag depends on the whole lift;
/// all of it belongs to the flow part of the drag.
struct LoadsByPart {
  Eigen::Matrix<double, 3, force_part_count> specific_force;
  Eigen::Matrix<double, 3, part_count - force_part_count> moment;
};

/// Derivatives with respect to air velocity [m/s] and rates [rad/s]; zero for clamped quantities.
struct LoadsJacobian {
  Eigen::Matrix3d force_v_a, force_omega, moment_v_a, moment_omega;
};

/// The flow at air velocity v_a [m/s] and rates omega [rad/s], body axes.
Flow flow(const Eigen::Vector3d& v_a, const Eigen::Vector3d& omega, const Air& air, const Airframe& airframe);

/// The coefficients of a flow and fin deflections.
Coefficients coefficients(const Flow& flow, const Deflection& fins, const Airframe& airframe);

/// Force and moment of a flow and its coefficients.
Loads loads(const Flow& flow, const Coefficients& c, const Air& air, const Airframe& airframe);

/// Force and moment as in loads(), separately for each part.
LoadsByPart loads_by_part(const Flow& flow, const Deflection& fins, const Coefficients& c, const Air& air,
                          const Airframe& airframe);

/// The derivatives of loads(); v_a must be the air velocity from which `flow` was computed.
LoadsJacobian loads_jacobian(const Flow& flow, const Coefficients& c, const Eigen::Vector3d& v_a,
                             const Air& air, const Airframe& airframe);

}  // namespace canhil::wind
