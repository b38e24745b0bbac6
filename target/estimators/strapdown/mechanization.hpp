#pragma once
// The strapdown navigation equations in north-east-down axes: one IMU increment carries a NavState one sample
// on.
#include <Eigen/Core>
#include <cstdint>

#include "target/estimators/strapdown/imu_increment.hpp"

namespace canhil::strapdown {

struct NavState {
  Eigen::Matrix3d C_bn = Eigen::Matrix3d::Identity();  // body to navigation (NED) axes
  Eigen::Vector3d v_eb_n = Eigen::Vector3d::Zero();    // [m/s]
  double latitude = 0, longitude = 0;                  // [rad]
  double height = 0;                                   // above the ellipsoid [m]
};

/// A navigation step, and what an error model needs of it: the interval's specific force, attitude and rates.
struct MechanizationStep {
  NavState nav;               // at the end of the interval
  Eigen::Vector3d delta_v_n;  // integral of C_bn f_ib_b [m/s]: the mean specific force times dt
  Eigen::Matrix3d C_bn_mean;
  Eigen::Vector3d omega_ie_n, omega_en_n;  // [rad/s]
};

enum class Mechanization : std::uint8_t { reference, two_sample, one_sample };

/// One sample taken as constant rate and specific force; earth terms frozen at its start (the published
/// vectors' rule). C1 = exp(-[w_in dt x]) C exp([dtheta x]), V1 = V + (C + C1)/2 dv + (g - (2w_ie + w_en) x
/// V) dt. Requires dt > 0.
MechanizationStep mechanize_reference(const NavState& nav, const ImuIncrement& imu);

/// Rate and specific force taken as linear over this sample and the one before: coning and sculling to
/// second order, rotation to third, earth terms at the middle of the sample (Savage 1998, parts 1 and 2, for
/// unequal sample times). `previous` with dt = 0 (none yet) leaves out the terms that need it. Requires dt >
/// 0.
MechanizationStep mechanize_two_sample(const NavState& nav, const ImuIncrement& previous,
                                       const ImuIncrement& imu);

/// One sample, specific force turned by half of its own rotation, earth terms frozen at its start (the
/// published in-flight vectors' rule): C1 = C exp([(dtheta - C' w_in dt) x]), V1 = V + C (dv + dtheta x dv/2)
/// + (g - (2w_ie + w_en) x V) dt, gravity in proportion to 1 - 2h/a, longitude by the
/// parallel of the end. Requires dt > 0.
MechanizationStep mechanize_one_sample(const NavState& nav, const ImuIncrement& imu);

/// A step of the kind asked for; `previous` serves two_sample alone.
MechanizationStep mechanize(Mechanization kind, const NavState& nav, const ImuIncrement& previous,
                            const ImuIncrement& imu);

}  // namespace canhil::strapdown
