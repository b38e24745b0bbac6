#pragma once
// The paper's model: heading and tilt errors are Euler angles psi from the platform p (NED according to the
// INS's attitude) to the computer frame c: C_pc(psi) = Rz(psi_z) Ry(psi_y) Rx(psi_x), C_bc = C_pc C_bp. S is
// the integral of C_bp f over the interval, and A is the integral of C_bp; n is the accelerometer bias, e is
// the gyro bias, and w = w_ie + w_en:
//   dV   += S - C_pc (S - A n) + ...
//   psi  += E(psi) [(w - C_pc' w) T - A e]
// (Kang, Kim, Park 2006, eq. (9); corrected: the bias enters through C_pc, and C_pc' replaces the paper's
// C_cc).
#include "target/estimators/inflight_alignment/error_model.hpp"

namespace canhil::inflight_alignment {

/// C_pc of psi [rad] (eqs. (7) and (8); corrected: the printed (8) lacks the minus of -sin psi_z in row 1,
/// column 2).
Eigen::Matrix3d platform_to_computer(const Eigen::Vector3d& psi);

/// The axes a_i, in the computer frame c, about which C_pc turns when psi_x, psi_y or psi_z changes:
/// d(C_pc v)/dpsi_i = a_i x C_pc v. The matrix also converts small errors of the angles at psi to a rotation
/// vector in c.
Eigen::Matrix3d rotation_axes(const Eigen::Vector3d& psi);

/// x after the interval; N = 15 or 18.
template <int N>
Vector<N> predicted(const Vector<N>& x, const Interval& interval);

/// The Jacobian of predicted() at x, minus I. E is replaced by I, as in the published runs: E - I is of the
/// order of the tilts, and it multiplies rates of the order of the earth's rate.
template <int N>
Transition<3> transition(const Vector<N>& x, const Interval& interval);

/// The extended Kalman filter's prediction over the interval.
template <int N>
void predict_ekf(Errors<N>& errors, const Interval& interval, const Settings& settings);

/// The unscented prediction with N + kappa = 3 (weights 1/6, centre 1 - N/3); returns the number of repairs
/// of P.
template <int N>
int predict_ukf(Errors<N>& errors, const Interval& interval, const Settings& settings);

}  // namespace canhil::inflight_alignment
