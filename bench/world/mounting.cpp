#include "bench/world/mounting.hpp"

#include <Eigen/Geometry>

namespace canhil::world {

Matrix3 mounted(const Vector3& roll_pitch_yaw) {
  return C_bn_from({.roll = roll_pitch_yaw.x(), .pitch = roll_pitch_yaw.y(), .heading = roll_pitch_yaw.z()})
      .transpose();
}

Vector3 velocity_at(const Truth& truth, const Vector3& lever_arm) {
  const Vector3 omega_eb_b = truth.omega_ib_b - truth.C_bn.transpose() * omega_ie_n(truth.position.latitude);
  return truth.v_eb_n + truth.C_bn * omega_eb_b.cross(lever_arm);
}

ImuIncrement increment_at(const ImuIncrement& at_origin, const Vector3& lever_arm, const Vector3& before,
                          const Vector3& after) {
  const double dt = 1e-6 * static_cast<double>(at_origin.interval_us);
  const auto centripetal = [&](const Vector3& omega) -> Vector3 {
    return omega.cross(omega.cross(lever_arm));
  };
  const Vector3 middle = (6 / dt * at_origin.delta_theta - before - after) / 4;
  ImuIncrement increment = at_origin;
  increment.delta_v += (after - before).cross(lever_arm) +
                       dt / 6 * (centripetal(before) + 4 * centripetal(middle) + centripetal(after));
  return increment;
}

}  // namespace canhil::world
