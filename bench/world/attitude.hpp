// Attitude conventions of the bench. The matrix C_bn transforms from the body axes b to the navigation axes n
// (NED). Euler angles have the order 3-2-1. A small attitude error phi has its components along the axes n.
#pragma once

#include <Eigen/Core>

namespace canhil::world {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// Euler angles 3-2-1 from NED to body [rad].
struct Euler {
  double roll = 0;
  double pitch = 0;
  double heading = 0;
};

/// The equivalent angle in [-pi, pi]. An angle that is already in this range is returned unchanged.
double wrapped(double angle);

/// The matrix C_bn for given Euler angles: the transpose of Groves (2013), eq. (2.22).
Matrix3 C_bn_from(const Euler& angles);

/// Euler angles of C_bn: roll and heading in (-pi, pi], pitch in [-pi/2, pi/2]. Groves (2013), eq. (2.23).
Euler euler_from(const Matrix3& C_bn);

/// [a x], so that skew(a) * b = a x b.
Matrix3 skew(const Vector3& a);

/// exp([a x]): the rotation by |a| about a (Rodrigues).
Matrix3 rotation(const Vector3& a);

/// The angular rate of the body relative to the navigation axes, in body axes [rad/s]. It is computed from
/// the Euler angles and their time derivatives [rad/s].
Vector3 omega_nb_b(const Euler& angles, const Euler& rates);

/// The attitude that a navigation system computes if its misalignment is phi [rad, NED]: exp(-[phi x]) C_bn.
Matrix3 misaligned(const Matrix3& C_bn, const Vector3& phi);

/// The misalignment phi [rad, NED] of the attitude `computed`, which is exp(-[phi x]) C_bn. This is the
/// inverse of misaligned().
Vector3 misalignment(const Matrix3& computed, const Matrix3& C_bn);

}  // namespace canhil::world
