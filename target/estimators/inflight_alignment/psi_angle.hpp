#pragma once
// The paper's model: the heading and tilt errors as Euler angles psi of the platform p (what the INS takes
// for NED) to the computer frame c, C_pc(psi) = Rz(psi_z) Ry(psi_y) Rx(psi_x), C_bc = C_pc C_bp. With S and A
// the interval's integrals of C_bp f and C_bp, n and e the accelerometer and gyro biases, w = w_ie + w_en:
//   dV   += S - C_pc (S - A n) + ...             (Kang, Kim, Park 2006, eq. (9); corrected: the bias enters
//   psi  += E(psi) [(w - C_pc' w) T - A e]        through C_pc, and C_pc' where the paper has C_cc)
#include "target/estimators/inflight_alignment/error_model.hpp"

namespace canhil::inflight_alignment {

/// C_pc of psi [rad] (eq. (7); corrected: -sin psi_z in row 1, column 2).
Eigen::Matrix3d platform_to_computer(const Eigen::Vector3d& psi);

/// The axes, in c, about which C_pc turns with psi_x, psi_y, psi_z: d(C_pc v)/dpsi_i = a_i x C_pc v. They
/// also take small angle errors at psi to a rotation vector in c.
Eigen::Matrix3d rotation_axes(const Eigen::Vector3d& psi);

/// x after the interval; N = 15 or 18.
template <int N>
Vector<N> predicted(const Vector<N>& x, const Interval& interval);

/// The Jacobian of predicted() at x, less I, with E = I as in the published runs: E is of the
/// order of the tilts and multiplies rates of the order of earth's.
template <int N>
Transition<3> transition(const Vector<N>& x, const Interval& interval);

/// The extended Kalman filter's prediction over the interval.
template <int N>
void predict_ekf(Errors<N>& errors, const Interval& interval, const Settings& settings);

/// The unscented prediction with N + kappa = 3 (weights 1/6, the centre's 1 - N/3); returns how often P had
/// to be made positive definite.
template <int N>
int predict_ukf(Errors<N>& errors, const Interval& interval, const Settings& settings);

}  // namespace canhil::inflight_alignment
