// The vertical channel of an INS, aided by barometric heights: a Kalman filter estimates three errors, and
// the estimates correct the INS.
//
// An error is the estimated value minus the true value. The three errors are dh of the height h, dv of the
// downward velocity v, and db of the bias b of the accelerometer along body z:
//   d(dh)/dt = -dv      d(dv)/dt = -(2 g0 / R) dh - C_zz db + noise      d(db)/dt = 0
// Without aiding these errors grow, because gravity is computed at the wrong height. Groves (2013),
// sections 5.7.2 and 16.2.
#pragma once

#include <Eigen/Core>

#include "target/estimators/strapdown/mechanization.hpp"

namespace canhil::baro_inertial {

struct Settings {
  double accel_bias_sigma_0 = 0;   ///< [m/s^2]
  double accel_noise_density = 0;  ///< [m/s^2/sqrt(Hz)]
  double height_sigma_0 = 0;       ///< [m]
  double velocity_sigma_0 = 0;     ///< [m/s]
  double barometer_sigma = 1;      ///< 1-sigma of a barometric height [m]
  double gate = 0;                 ///< largest accepted NIS; 0: no gate
};

enum class Outcome : bool { gated, used };

class VerticalChannel {
 public:
  void start(const strapdown::NavState& nav, const Settings& settings);
  /// Propagates the INS and the covariance over one IMU sample.
  void propagate(const strapdown::ImuIncrement& imu, const Settings& settings);
  /// Corrects the INS and the bias with a barometric height [m], which must be valid at the time of the INS.
  Outcome update(double height, const Settings& settings);

  [[nodiscard]] const strapdown::NavState& nav() const { return nav_; }
  [[nodiscard]] double bias() const { return bias_; }            ///< accelerometer along body z [m/s^2]
  [[nodiscard]] double nis() const { return nis_; }              ///< of the last height, 1 degree of freedom
  [[nodiscard]] const Eigen::Matrix3d& P() const { return P_; }  ///< covariance of dh, dv, db
  [[nodiscard]] bool finite() const { return nav_.v_eb_n.allFinite() && P_.allFinite(); }

 private:
  strapdown::NavState nav_;
  strapdown::ImuIncrement before_;
  double bias_ = 0;
  double nis_ = 0;
  Eigen::Matrix3d P_ = Eigen::Matrix3d::Zero();
};

}  // namespace canhil::baro_inertial
