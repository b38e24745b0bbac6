#include "target/estimators/transfer_alignment/invariant.hpp"

#include <cmath>

#include "target/estimators/strapdown/attitude.hpp"

namespace canhil::transfer_alignment {
namespace {

using Eigen::Vector3d;

// J(phi) v = v + (1 - cos a)/a^2 phi x v + (a - sin a)/a^3 phi x (phi x v), a = |phi|.
Vector3d times_left_jacobian(const Vector3d& phi, const Vector3d& v) {
  const double x = phi.squaredNorm();
  double first = 0.5 * (1 - x / 12 * (1 - x / 30));
  double second = (1 - x / 20 * (1 - x / 42)) / 6;
  if (x > 1e-3) {  // for smaller x the first omitted term is below 1e-13
    const double angle = std::sqrt(x);
    first = (1 - std::cos(angle)) / x;
    second = (1 - std::sin(angle) / angle) / x;
  }
  const Eigen::Matrix3d cross = strapdown::skew(phi);
  const Vector3d phi_v = cross * v;
  return v + first * phi_v + second * (cross * phi_v);
}

}  // namespace

StateVector invariant_correction(const Eigen::Matrix<double, state_count, 3>& K, const Vector3d& y) {
  StateVector x = K.lazyProduct(y);
  const Vector3d phi = x.segment<3>(attitude_state);
  const Vector3d zeta = x.segment<3>(velocity_state);
  // The innovation that remains after the correction, in the axes before the correction.
  const Vector3d left = strapdown::exp_rotation(-phi) * (y - times_left_jacobian(phi, zeta));
  x.noalias() = K.lazyProduct(left + zeta);
  x.segment<3>(velocity_state) =
      times_left_jacobian(x.segment<3>(attitude_state), x.segment<3>(velocity_state));
  return x;
}

void turn_with_correction(Covariance& P, const Vector3d& phi) {
  static_assert(velocity_state == 0 && attitude_state == 3);
  const Eigen::Matrix3d turn = strapdown::exp_rotation(phi).transpose();
  Eigen::Matrix<double, state_count, 6> X;
  X.leftCols<3>().noalias() = P.leftCols<3>().lazyProduct(turn);
  X.rightCols<3>().noalias() = P.middleCols<3>(attitude_state).lazyProduct(turn);
  const Eigen::Matrix<double, 6, 6> Xt = X.topRows<6>().transpose();
  P.bottomLeftCorner<6, 6>() = X.bottomRows<6>();
  P.topLeftCorner<6, 3>().noalias() = Xt.leftCols<3>().lazyProduct(turn);
  P.block<6, 3>(0, 3).noalias() = Xt.rightCols<3>().lazyProduct(turn);
  filtering::mirror_lower<state_count>(P);
}

Eigen::Vector2d initial_tilt_variance(const Vector3d& stated) {
  return stated.head<2>() * (1 + 40 * stated.z());
}

}  // namespace canhil::transfer_alignment
