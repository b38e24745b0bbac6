#pragma once
// One sample of a strapdown IMU: the integrals of angular rate and specific force over the sample time.
#include <Eigen/Core>

namespace canhil::strapdown {

/// One sample: increments of angle and velocity, body axes.
struct ImuIncrement {
  Eigen::Vector3d delta_theta = Eigen::Vector3d::Zero();  // integral of omega_ib_b [rad]
  Eigen::Vector3d delta_v = Eigen::Vector3d::Zero();      // integral of f_ib_b [m/s]
  double dt = 0;                                          // [s]
  // Variances of the errors of an increment that bridges lost samples, beyond those of the sensor.
  Eigen::Vector3d delta_theta_variance = Eigen::Vector3d::Zero();  // [rad^2]
  Eigen::Vector3d delta_v_variance = Eigen::Vector3d::Zero();      // [(m/s)^2]
};

/// The increment minus constant biases of the rate [rad/s] and the specific force [m/s^2].
inline ImuIncrement without_bias(const ImuIncrement& imu, const Eigen::Vector3d& gyro_bias,
                                 const Eigen::Vector3d& accel_bias) {
  return {imu.delta_theta - gyro_bias * imu.dt, imu.delta_v - accel_bias * imu.dt, imu.dt};
}

}  // namespace canhil::strapdown
