#include "bench/world/attitude.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace canhil::world {

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

Matrix3 C_bn_from(const Euler& angles) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(angles.heading, Vector3::UnitZ()) * AngleAxisd(angles.pitch, Vector3::UnitY()) *
          AngleAxisd(angles.roll, Vector3::UnitX()))
      .toRotationMatrix();
}

Euler euler_from(const Matrix3& C_bn) {
  return {.roll = std::atan2(C_bn(2, 1), C_bn(2, 2)),
          .pitch = std::asin(std::clamp(-C_bn(2, 0), -1.0, 1.0)),
          .heading = std::atan2(C_bn(1, 0), C_bn(0, 0))};
}

Matrix3 skew(const Vector3& a) {
  Matrix3 S;
  S << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return S;
}

Matrix3 rotation(const Vector3& a) { return Eigen::AngleAxisd(a.norm(), a.normalized()).toRotationMatrix(); }

// omega_nb_b = [roll'; 0; 0] + R_x(roll) ([0; pitch'; 0] + R_y(pitch) [0; 0; heading'])
Vector3 omega_nb_b(const Euler& angles, const Euler& rates) {
  const double sr = std::sin(angles.roll);
  const double cr = std::cos(angles.roll);
  const double sp = std::sin(angles.pitch);
  const double cp = std::cos(angles.pitch);
  return {rates.roll - rates.heading * sp, rates.pitch * cr + rates.heading * cp * sr,
          -rates.pitch * sr + rates.heading * cp * cr};
}

Matrix3 misaligned(const Matrix3& C_bn, const Vector3& phi) { return rotation(-phi) * C_bn; }

Vector3 misalignment(const Matrix3& computed, const Matrix3& C_bn) {
  const Eigen::AngleAxisd turn(Matrix3(computed * C_bn.transpose()));
  return -turn.angle() * turn.axis();
}

}  // namespace canhil::world
