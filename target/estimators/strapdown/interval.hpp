#pragma once
// The strapdown solution between two updates of a filter, as integrals. The integrals stay valid even if the
// specific force changes abruptly between the updates.
#include <Eigen/Core>

#include "target/estimators/strapdown/mechanization.hpp"

namespace canhil::strapdown {

/// Integrals since the last update of a filter.
struct Interval {
  double duration = 0;                                      // [s]
  Eigen::Vector3d delta_v_n = Eigen::Vector3d::Zero();      // integral of C_bn f_ib_b [m/s]
  Eigen::Matrix3d C_bn_integral = Eigen::Matrix3d::Zero();  // integral of C_bn [s]
  Eigen::Vector3d omega_ie_n = Eigen::Vector3d::Zero();     // of the last sample [rad/s]
  Eigen::Vector3d omega_en_n = Eigen::Vector3d::Zero();
  // Variances of the increments that bridge lost samples, body axes (ImuIncrement).
  Eigen::Vector3d delta_theta_variance = Eigen::Vector3d::Zero();  // [rad^2]
  Eigen::Vector3d delta_v_variance = Eigen::Vector3d::Zero();      // [(m/s)^2]
};

/// Extends the interval by the mechanisation step of an increment.
inline void extend(Interval& interval, const MechanizationStep& step, const ImuIncrement& imu) {
  const double dt = imu.dt;
  interval.duration += dt;
  interval.delta_theta_variance += imu.delta_theta_variance;
  interval.delta_v_variance += imu.delta_v_variance;
  interval.delta_v_n += step.delta_v_n;
  interval.C_bn_integral += step.C_bn_mean * dt;
  interval.omega_ie_n = step.omega_ie_n;
  interval.omega_en_n = step.omega_en_n;
}

/// A root B of the covariance B B' in n axes, for variances along the body axes: B = C_bn diag(sigma), with
/// the mean attitude of the interval.
inline Eigen::Matrix3d root_in_n(const Interval& interval, const Eigen::Vector3d& variance) {
  return interval.C_bn_integral / interval.duration * variance.cwiseSqrt().asDiagonal();
}

}  // namespace canhil::strapdown
