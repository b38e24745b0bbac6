#pragma once
// The product with the transition's blocks; separate from error_model.hpp because it is slow to compile.
#include "target/estimators/inflight_alignment/error_model.hpp"

namespace canhil::inflight_alignment {

/// The columns of a matrix [.. x N] that the product with G' reads: all except those of the fix bias, on
/// which no other state depends.
template <int Rows, int A>
using FirstStates = Eigen::Map<const Matrix<Rows, 12 + A>, Eigen::Aligned16>;

/// M G' [Rows x moving].
template <int Rows, int A>
Matrix<Rows, 6 + A> times_transposed(const FirstStates<Rows, A>& M, const Transition<A>& G) {
  using At = Layout<12 + A>;
  const double T = G.T;
  Matrix<Rows, 6 + A> out;
  auto position = out.template middleCols<3>(At::position);
  auto velocity = out.template middleCols<3>(At::velocity);
  auto attitude = out.template middleCols<A>(At::attitude);
  const auto M_R = M.template middleCols<3>(At::position);
  const auto M_V = M.template middleCols<3>(At::velocity);
  const auto M_att = M.template middleCols<A>(At::attitude);
  const auto M_acc = M.template middleCols<3>(At::accel_bias);
  const auto M_gyr = M.template middleCols<3>(At::gyro_bias);
  velocity.noalias() = M_att.lazyProduct(G.velocity_attitude.transpose());
  velocity.noalias() += M_acc.lazyProduct(G.velocity_accel.transpose());
  velocity.noalias() += M_V.lazyProduct(G.coriolis.transpose());
  velocity.noalias() += M_R * (T * gravity_error_per_m()).asDiagonal();
  position.noalias() = M_R.lazyProduct(G.transport.transpose());
  position += T * M_V + (T / 2) * velocity;
  attitude.noalias() = M_att.lazyProduct(G.attitude_attitude.transpose());
  attitude.noalias() += M_gyr.lazyProduct(G.attitude_gyro.transpose());
  return out;
}

}  // namespace canhil::inflight_alignment
