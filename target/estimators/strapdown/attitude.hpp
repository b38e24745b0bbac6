#pragma once
// Rotations: vectors, direction cosine matrices, Euler angles (3-2-1: heading, pitch, roll).
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace canhil::strapdown {

/// [a x]: skew(a) * b = a x b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// exp([phi x]), the direction cosine matrix of a rotation vector [rad] (Rodrigues; Groves 2013, eq. 5.73).
inline Eigen::Matrix3d exp_rotation(const Eigen::Vector3d& phi) {
  const double x = phi.squaredNorm();
  double a;        // sin |phi| / |phi|
  double b;        // (1 - cos |phi|) / |phi|^2
  if (x < 0.01) {  // the first term left out is below 3e-18
    a = 1 - x / 6 * (1 - x / 20 * (1 - x / 42 * (1 - x / 72)));
    b = 0.5 * (1 - x / 12 * (1 - x / 30 * (1 - x / 56 * (1 - x / 90))));
  } else {
    const double angle = std::sqrt(x);
    const double half = std::sin(angle / 2);
    a = std::sin(angle) / angle;
    b = 2 * half * half / x;
  }
  // I + a [phi x] + b [phi x]^2, and [phi x]^2 = phi phi' - |phi|^2 I
  const double c = 1 - b * x;
  const Eigen::Vector3d s = a * phi;
  const Eigen::Vector3d p = b * phi;
  Eigen::Matrix3d m;
  m << c + p.x() * phi.x(), p.x() * phi.y() - s.z(), p.x() * phi.z() + s.y(),  //
      p.x() * phi.y() + s.z(), c + p.y() * phi.y(), p.y() * phi.z() - s.x(),   //
      p.x() * phi.z() - s.y(), p.y() * phi.z() + s.x(), c + p.z() * phi.z();
  return m;
}

/// The rotation vector [rad], |phi| <= pi, of a direction cosine matrix: the inverse of exp_rotation.
inline Eigen::Vector3d log_rotation(const Eigen::Matrix3d& C) {
  const Eigen::AngleAxisd rotation(C);
  return rotation.angle() * rotation.axis();
}

/// The attitude error phi [rad], n axes, of C_computed = exp(-[phi x]) C_true.
inline Eigen::Vector3d misalignment(const Eigen::Matrix3d& C_computed, const Eigen::Matrix3d& C_true) {
  return -log_rotation(C_computed * C_true.transpose());
}

struct Euler {
  double roll = 0, pitch = 0, heading = 0;  // [rad]
};

/// C_bn of roll, pitch, heading [rad] (Groves 2013, eq. 2.22 transposed).
inline Eigen::Matrix3d dcm_from_euler(const Euler& e) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(e.heading, Vector3d::UnitZ()) * AngleAxisd(e.pitch, Vector3d::UnitY()) *
          AngleAxisd(e.roll, Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Roll, pitch, heading [rad] of C_bn; pitch in +-pi/2, where (only) roll and heading are not unique.
inline Euler euler_from_dcm(const Eigen::Matrix3d& C) {
  return {std::atan2(C(2, 1), C(2, 2)), std::atan2(-C(2, 0), std::hypot(C(2, 1), C(2, 2))),
          std::atan2(C(1, 0), C(0, 0))};
}

/// One Newton step C (3 I - C'C)/2 to the nearest orthonormal matrix: an error e becomes of order e^2.
inline Eigen::Matrix3d reorthonormalised(const Eigen::Matrix3d& C) {
  const Eigen::Matrix3d gram = C.transpose() * C;
  return 1.5 * C - 0.5 * C * gram;
}

}  // namespace canhil::strapdown
