#pragma once
// Settings of the transfer-alignment filter. Defaults: the reproduction of Yang, Shim, Park 2001, where P0 of
// the attitude is deliberately 1 deg for true errors of 5 deg
// (target/estimators/transfer_alignment/NOTES.md). Recommended: kalman with Loop::invariant.
#include <Eigen/Core>
#include <cstdint>
#include <numbers>

#include "target/estimators/strapdown/mechanization.hpp"

namespace canhil::transfer_alignment {

/// One g [m/s^2], the unit of "g" and "ug" in sensor data sheets.
inline constexpr double standard_gravity = 9.80665;
/// One degree [rad].
inline constexpr double rad_per_deg = std::numbers::pi / 180;

/// The recursion of the covariance.
enum class Algorithm : std::uint8_t { kalman, robust_h2 };

/// Structure of the uncertain block A_v,phi = L Delta N. With S = [(1 1 1) x], cases one to four have
/// (L, N) = (alpha I, I), (alpha S, I), (I, alpha S), (I, alpha I). Cases one and four are the same filter:
/// their values of beta differ such that their H2 terms are equal.
enum class H2Case : std::uint8_t { one = 1, two, three, four };

/// cov_df: alpha is sqrt(tr([f x] P_phi [f x]')) with an upper limit, computed at each step
/// (the paper's ||dC f|| needs the unknown dC).
enum class AlphaRule : std::uint8_t { cov_df, constant };

/// How an update uses its correction. open: the correction is stored separately from the INS. published: the
/// correction is applied to the INS, but P is not rotated with the INS. invariant: the correction of an
/// invariant error (invariant.hpp) is applied to the INS, and P is rotated with the INS; a Kalman step
/// replaces an H2 step that would make P too large (NOTES.md); velocities beyond the gate are refused.
enum class Loop : std::uint8_t { open, published, invariant };

/// The settings of the filter.
struct Settings {
  Algorithm algorithm = Algorithm::robust_h2;
  H2Case h2_case = H2Case::two;
  AlphaRule alpha_rule = AlphaRule::cov_df;
  double alpha_constant = 0;  // [m/s^2], for AlphaRule::constant
  double fading_per_s =
      0;  // Kalman only: P grows by exp(2 fading dt), i.e. sigmas by exp(fading dt), before Q
  Loop loop = Loop::published;
  strapdown::Mechanization mechanization = strapdown::Mechanization::two_sample;

  // Loop::invariant: the gate refuses velocities with a larger NIS; 0: no gate. Velocities in a turn must
  // pass the gate even with a heading error of three sigmas (90 deg), for which the first-order model is far
  // from valid. With a gate of 250, one of 200 runs became inconsistent (NEES).
  double gate_nis = 2000;
  std::uint32_t gate_recovery = 5;  // the gate refuses at most this many velocities in a row

  // R of the master: R_k = R/dt [(m/s)^2 s]. dt: the time since the last velocity; with Loop::invariant, the
  // master's period, so that the first velocity after an outage counts as any other.
  double velocity_noise_density = 0.01;
  double velocity_period = 0.1;  // Loop::invariant: the master's period, until velocities show it [s]
  double accel_noise_density = 50e-6 * standard_gravity;  // [m/s^2/sqrt(Hz)]
  double gyro_noise_density = 0.125 * rad_per_deg / 60;   // [rad/s/sqrt(Hz)]

  // Loop::invariant: errors that the filter considers (considered.hpp), 1-sigma.
  double accel_scale_factor_sigma = 0;   // [-]
  double accel_misalignment_sigma = 0;   // of each axis towards each other one [rad]
  double gyro_scale_factor_sigma = 0;    // [-]
  double gyro_misalignment_sigma = 0;    // [rad]
  double lever_arm_sigma = 0;            // from the master's place to the IMU, each axis [m]
  double velocity_correlated_sigma = 0;  // of the master, in addition to the white noise [m/s]
  double velocity_correlation_s = 5;     // its correlation time [s]

  Eigen::Vector3d velocity_sigma_0 = Eigen::Vector3d::Constant(1.0);                          // NED [m/s]
  Eigen::Vector3d attitude_sigma_0 = Eigen::Vector3d::Constant(rad_per_deg);                  // NED [rad]
  Eigen::Vector3d accel_bias_sigma_0 = Eigen::Vector3d::Constant(300e-6 * standard_gravity);  // body [m/s^2]
  Eigen::Vector3d gyro_bias_sigma_0 = Eigen::Vector3d::Constant(3 * rad_per_deg / 3600);      // body [rad/s]
};

}  // namespace canhil::transfer_alignment
