#pragma once
// Settings of the in-flight alignment. Defaults: the recommended filter with the sensors of Kang, Kim, Park
// 2006 and an SSBL (target/estimators/inflight_alignment/NOTES.md).
#include <Eigen/Core>
#include <cstdint>
#include <numbers>

namespace canhil::inflight_alignment {

/// One g [m/s^2], the unit of "g" and "ug" in sensor data sheets.
inline constexpr double standard_gravity = 9.80665;
/// One degree [rad].
inline constexpr double rad_per_deg = std::numbers::pi / 180;

/// sin_cos: sine and cosine of the heading error are states; the model is linear in these states, so the
/// heading error at the start may have any size. ekf, ukf: the paper's filters, with psi angles as states.
enum class Algorithm : std::uint8_t { ekf, ukf, sin_cos };

/// The source of fixes. ssbl: fixes have a constant bias, which adds three states.
enum class Aiding : std::uint8_t { ssbl, gps };

/// The axes in which ekf and ukf estimate the tilts in a closed loop. When tilts and heading are fed back,
/// `platform` rotates the rows of P for the tilts by the heading correction, `navigation` does not. An open
/// loop uses platform axes, like the paper.
enum class AttitudeErrorFrame : std::uint8_t { platform, navigation };

/// The square root of P. The offsets of the sigma points are proportional to its columns.
enum class UkfRoot : std::uint8_t { lower_cholesky, symmetric };

/// The point about which the UKF computes second moments. about_central: the transformed central point; P is
/// then positive semi-definite for any weights.
enum class UkfCovariance : std::uint8_t { about_mean, about_central };

/// How sin_cos treats tilts and biases (sin_cos.hpp). published: the model is of first order in the tilts,
/// the tilts stay in the states until the heading is fed back, and the biases are in body axes. levelled: the
/// tilts are fed back at each fix, the vertical force is of second order in the tilts, and the biases are
/// turned with the heading error.
enum class SinCosForm : std::uint8_t { published, levelled };

/// When a late fix is applied.
enum class LateFixes : std::uint8_t { at_arrival, at_validity };

/// The settings of the filter.
struct Settings {
  Algorithm algorithm = Algorithm::sin_cos;
  Aiding aiding = Aiding::ssbl;
  bool closed_loop = false;  // for ekf and ukf; sin_cos always feeds back
  AttitudeErrorFrame attitude_error_frame = AttitudeErrorFrame::platform;
  UkfRoot ukf_root = UkfRoot::lower_cholesky;
  UkfCovariance ukf_covariance = UkfCovariance::about_mean;
  SinCosForm sin_cos_form = SinCosForm::levelled;
  LateFixes late_fixes = LateFixes::at_validity;

  double accel_noise_density = 50e-6 * standard_gravity;  // [m/s^2/sqrt(Hz)]
  double gyro_noise_density = 0.3 * rad_per_deg / 60;     // [rad/s/sqrt(Hz)]
  double fix_noise_horizontal = 2;                        // each of north and east, 1-sigma [m]
  double fix_noise_vertical = 2;                          // [m]
  double fix_bias_noise_density = 0;                      // random walk of the fix bias [m/sqrt(s)]
  double fix_correlated_share = 0;  // levelled: share of a fix's variance that is correlated in time, 0 to 1
  double fix_correlation_time = 0;  // of this share [s]; 0: not known
  double handover_sigma = 2 * rad_per_deg;  // sin_cos: heading sigma below which attitude is fed back
  double longest_interval = 1.5;            // after this time without a fix the filter predicts [s]
  double gate_nis = 0;                      // the gate refuses fixes with a larger NIS; 0: no gate
  std::uint32_t gate_recovery = 5;          // the gate refuses at most this many fixes in a row

  Eigen::Vector3d position_sigma_0 = Eigen::Vector3d::Constant(5);    // NED [m]
  Eigen::Vector3d velocity_sigma_0 = Eigen::Vector3d::Constant(0.1);  // NED [m/s]
  double tilt_sigma_0 = rad_per_deg;                                  // each of two [rad]
  double heading_sigma_0 = 90 * rad_per_deg;                          // [rad]
  double start_acceleration_sigma = 1;  // levelled: vehicle's acceleration at the start, each axis [m/s^2]
  double accel_bias_sigma_0 = 1000e-6 * standard_gravity;  // each axis [m/s^2]
  double gyro_bias_sigma_0 = 1 * rad_per_deg / 3600;       // each axis [rad/s]
  double fix_bias_sigma_0 = 3.1622776601683795;            // sqrt(1^2 + 3^2) of SSBL and ship [m]
};

}  // namespace canhil::inflight_alignment
