#pragma once
// The heading error as two states, s = sin psi_z and k = 1 - cos psi_z, and the tilts phi = (phi_x, phi_y, 0)
// in the computer frame: C_pc = exp([phi x]) Rz(psi_z). The velocity error is then linear in the attitude
// states phi_x phi_y s k, for a heading error of any size.
//
// SinCosForm::levelled keeps the model valid for large tilts, without using an estimate of the heading:
//   horizontal force    Rz S + phi x (S_z e_z), which is linear in (phi, s, k)
//   vertical force      S_z + (phi x Rz S)_z - phi^2 S_z / 2; the filter includes the mean and the variance
//                       of the terms of second order
//   biases              The states are b' = Rz b. Then Rz A b = Rz A Rz' b', which equals A b' if the vehicle
//                       only yaws.
//   tilt                It is removed from the INS at each fix (take_out_tilt), so that phi stays small.
#include "target/estimators/inflight_alignment/error_model.hpp"

namespace canhil::inflight_alignment {

/// psi_z [rad] = atan2(s, 1 - k).
template <int N>
double heading_error(const Vector<N>& x);

/// C_pc of the estimate.
template <int N>
Eigen::Matrix3d tilt_and_heading(const Vector<N>& x);

/// d(phi_x, phi_y, psi_z)/d(phi_x, phi_y, s, k) at the estimate, with |(s, 1 - k)| limited to at least 0.01.
template <int N>
Matrix<3, 4> angles_of_states(const Vector<N>& x);

/// Sets mean and covariance of (s, k) for psi_z ~ N(0, sigma^2) [rad]; a large sigma: all headings are
/// equally likely.
template <int N>
void set_heading_prior(Errors<N>& errors, double sigma);

/// x after the interval; N = 16 or 19.
template <int N>
Vector<N> predicted_sin_cos(const Errors<N>& errors, const Interval& interval);

/// The Jacobian of predicted_sin_cos() at the estimate, minus I. It omits the derivative of the product of
/// heading error and biases.
template <int N>
Transition<4> transition_sin_cos(const Errors<N>& errors, const Interval& interval);

/// The Kalman filter's prediction over the interval.
template <int N>
void predict_sin_cos(Errors<N>& errors, const Interval& interval, const Settings& settings);

/// True when the heading can be fed back as an angle: its sigma is below the settings' handover_sigma, and
/// (s, 1 - k) is near the unit circle.
template <int N>
bool heading_is_resolved(const Errors<N>& errors, const Settings& settings);

/// True if the estimates of sine and cosine of the heading error are too far from a circle of radius 1 for
/// their covariance: on a straight path a wrong gyro bias moves them by its ratio to the earth's rate. Begins
/// at 4 sigmas and, if it `was` so, ends at 2.
template <int N>
bool is_off_circle(const Errors<N>& errors, bool was);

/// Rz', which turns biases b' into body axes; I in the published form.
template <int N>
Eigen::Matrix3d axes_of_biases(const Errors<N>& errors);

/// Converts the biases b' and their covariance to body axes: b = Rz' b', db = Rz' (db' - dpsi e_z x b') with
/// dpsi = c ds + s dk. Does nothing in the published form.
template <int N>
void turn_biases_back(Errors<N>& errors);

/// Removes from x the tilt in platform axes, phi_p = E[Rz' phi] / E[s^2 + (1 - k)^2] [rad], which can be
/// estimated for any heading error. Returns exp([phi_p x]), by which the caller corrects the INS. The
/// remaining rotation exp([phi x]) Rz exp([-phi_p x]) has the tilt
///   phi' = phi - Rz phi_p = phi - phi_p + k phi_p - s e_z x phi_p,
/// which is linear in (s, k); P is mapped accordingly.
template <int N>
Eigen::Matrix3d take_out_tilt(Errors<N>& errors);

/// Removes tilts and heading from x, returns C_pc for the INS, and maps the covariance of the attitude
/// states: the new s is s cos psi_z + k sin psi_z; the new k is 0, because k now follows from s. Biases: see
/// turn_biases_back(). After the removal of the estimates the remaining rotation is
///   exp([phi x]) Rz(dpsi) exp([-phi_hat x]) = exp([phi' x]) Rz(dpsi),   phi' = phi - Rz(dpsi) phi_hat,
/// so in first order dphi' = dphi - dpsi e_z x phi_hat. The published form omits the term with dpsi.
template <int N>
Eigen::Matrix3d take_out_attitude(Errors<N>& errors);

}  // namespace canhil::inflight_alignment
