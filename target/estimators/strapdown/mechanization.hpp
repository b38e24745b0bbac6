#pragma once
// The strapdown navigation equations in north-east-down axes: one IMU increment advances a NavState by one
// sample.
#include <Eigen/Core>
#include <cstdint>

#include "target/estimators/strapdown/imu_increment.hpp"

namespace canhil::strapdown {

/// Attitude, velocity and position of a navigation system.
struct NavState {
  Eigen::Matrix3d C_bn = Eigen::Matrix3d::Identity();  // body to navigation (NED) axes
  Eigen::Vector3d v_eb_n = Eigen::Vector3d::Zero();    // [m/s]
  double latitude = 0, longitude = 0;                  // [rad]
  double height = 0;                                   // above the ellipsoid [m]
};

/// A navigation step, with the inputs of an error model: the interval's specific force, attitude and rates.
struct MechanizationStep {
  NavState nav;               // at the end of the interval
  Eigen::Vector3d delta_v_n;  // integral of C_bn f_ib_b [m/s]: the mean specific force times dt
  Eigen::Matrix3d C_bn_mean;
  Eigen::Vector3d omega_ie_n, omega_en_n;  // [rad/s]
};

/// The mechanisation, see mechanize().
enum class Mechanization : std::uint8_t { reference, two_sample, one_sample };

/// Assumes that rate and specific force are constant over the sample, and that the earth terms keep their
/// values of the start of the sample, as in the published test vectors.
/// C1 = exp(-[w_in dt x]) C exp([dtheta x]), V1 = V + (C + C1)/2 dv + (g - (2w_ie + w_en) x V) dt. Requires
/// dt > 0.
MechanizationStep mechanize_reference(const NavState& nav, const ImuIncrement& imu);

/// Assumes that rate and specific force are linear over this sample and the previous one. Coning and sculling
/// are computed to second order, the rotation to third order, and the earth terms at the middle of the sample
/// (Savage 1998, parts 1 and 2, for unequal sample times). `previous.dt` = 0 means that there is no previous
/// sample; the terms that need a previous sample are omitted. Requires dt > 0.
MechanizationStep mechanize_two_sample(const NavState& nav, const ImuIncrement& previous,
                                       const ImuIncrement& imu);

/// Turns the specific force by half of the sample's rotation. The earth terms keep their values of the start
/// of the sample, as in the published test vectors of in-flight alignment:
/// C1 = C exp([(dtheta - C' w_in dt) x]), V1 = V + C (dv + dtheta x dv/2) + (g - (2w_ie + w_en) x V) dt.
/// Gravity is proportional to 1 - 2h/a, where a is the earth's semi-major axis. The rate of the longitude
/// uses the radius of the circle of latitude at the end of the sample. Requires dt > 0.
MechanizationStep mechanize_one_sample(const NavState& nav, const ImuIncrement& imu);

/// A step of the given kind; only two_sample uses `previous`.
MechanizationStep mechanize(Mechanization kind, const NavState& nav, const ImuIncrement& previous,
                            const ImuIncrement& imu);

}  // namespace canhil::strapdown
