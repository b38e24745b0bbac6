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
};

/// Extends the interval by a mechanisation step of dt [s].
inline void extend(Interval& interval, const MechanizationStep& step, double dt) {
  interval.duration += dt;
  interval.delta_v_n += step.delta_v_n;
  interval.C_bn_integral += step.C_bn_mean * dt;
  interval.omega_ie_n = step.omega_ie_n;
  interval.omega_en_n = step.omega_en_n;
}

}  // namespace canhil::strapdown
