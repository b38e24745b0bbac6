#pragma once
// The heading error as two states, s = sin psi_z and k = 1 - cos psi_z, and the tilts phi = (phi_x, phi_y, 0)
// in the computer frame: C_pc = exp([phi x]) Rz(psi_z). The specific force then enters the velocity error
// linearly, so that a heading error of any size is as good as a small one. Attitude states: phi_x phi_y s k.
#include "target/estimators/inflight_alignment/error_model.hpp"

namespace canhil::inflight_alignment {

/// psi_z [rad] = atan2(s, 1 - k).
template <int N>
double heading_error(const Vector<N>& x);

/// C_pc of the estimate.
template <int N>
Eigen::Matrix3d tilt_and_heading(const Vector<N>& x);

/// d(phi_x, phi_y, psi_z)/d(phi_x, phi_y, s, k) at the estimate, |(s, 1 - k)| taken as at least 0.01.
template <int N>
Matrix<3, 4> angles_of_states(const Vector<N>& x);

/// Mean and covariance of (s, k) for psi_z ~ N(0, sigma^2) [rad]; a large sigma: any heading alike.
template <int N>
void set_heading_prior(Errors<N>& errors, double sigma);

/// x after the interval; N = 16 or 19.
template <int N>
Vector<N> predicted_sin_cos(const Vector<N>& x, const Interval& interval);

/// The Jacobian, less I: of first order, at the present psi_z.
template <int N>
Transition<4> transition_sin_cos(const Vector<N>& x, const Interval& interval);

/// The Kalman filter's prediction over the interval.
template <int N>
void predict_sin_cos(Errors<N>& errors, const Interval& interval, const Settings& settings);

/// True once the heading is known well enough to be fed back as an angle: sigma below the settings' and (s, 1
/// - k) near the unit circle.
template <int N>
bool heading_is_resolved(const Errors<N>& errors, const Settings& settings);

/// Tilts and heading taken out of x, and their covariance mapped: s <- c s + s k, k <- 0, for k is not
/// independent of s any more. What remains of exp([phi x]) Rz(psi) after the estimates are taken out of it,
///   exp([phi x]) Rz(dpsi) exp([-phi_hat x]) = exp([phi' x]) Rz(dpsi),   phi' = phi - Rz(dpsi) phi_hat,
/// so that with HandoverTilts::turned dphi' = dphi - dpsi e_z x phi_hat: of first order, for phi_hat is.
template <int N>
void take_out_attitude(Errors<N>& errors, HandoverTilts tilts);

}  // namespace canhil::inflight_alignment
