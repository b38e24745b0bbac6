#pragma once
// Rotations: vectors, direction cosine matrices, Euler angles (3-2-1: heading, pitch, roll).
#include <Eigen/Core>

namespace canhil::strapdown {

/// [a x]: skew(a) * b = a x b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// exp([phi x]), the direction cosine matrix of a rotation vector [rad] (Rodrigues; Groves 2013, eq. 5.73).
Eigen::Matrix3d exp_rotation(const Eigen::Vector3d& phi);

/// The rotation vector [rad], |phi| <= pi, of a direction cosine matrix: the inverse of exp_rotation.
Eigen::Vector3d log_rotation(const Eigen::Matrix3d& C);

/// The attitude error phi [rad] in n axes, which is defined by C_computed = exp(-[phi x]) C_true.
Eigen::Vector3d misalignment(const Eigen::Matrix3d& C_computed, const Eigen::Matrix3d& C_true);

/// Euler angles, yaw-pitch-roll sequence [rad].
struct Euler {
  double roll = 0, pitch = 0, heading = 0;  // [rad]
};

/// C_bn from roll, pitch, heading [rad] (Groves 2013, eq. 2.22 transposed).
Eigen::Matrix3d dcm_from_euler(const Euler& e);

/// Roll, pitch, heading [rad] of C_bn; pitch in [-pi/2, pi/2]. Roll and heading are not unique at +-pi/2.
Euler euler_from_dcm(const Eigen::Matrix3d& C);

/// One Newton step C (3 I - C'C)/2 towards the nearest orthonormal matrix: it reduces an error e to the order
/// of e^2.
Eigen::Matrix3d reorthonormalised(const Eigen::Matrix3d& C);

}  // namespace canhil::strapdown
