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

/// Assumes constant rate and specific force over the sample, and earth terms frozen at its start, as in
/// the published test vectors. C1 = exp(-[w_in dt x]) C exp([dtheta x]), V1 = V + (C + C1)/2 dv + (g - (2w_ie
/// + w_en) x V) dt. Requires dt > 0.
MechanizationStep mechanize_reference(const NavState& nav, const ImuIncrement& imu);

/// Assumes rate and specific force linear over this sample and the previous one: coning and sculling to
/// second order, rotation to third, earth terms at the middle of the sample (Savage 1998, parts 1 and 2, for
/// unequal sample times). `previous.dt` = 0 means that there is no previous sample; terms that need it are
/// omitted. Requires dt > 0.
MechanizationStep mechanize_two_sample(const NavState& nav, const ImuIncrement& previous,
                                       const ImuIncrement& imu);

/// Turns the specific force by half of the sample's rotation, with earth terms frozen at the start, as in
/// the published test vectors of in-flight alignment: C1 = C exp([(dtheta - C' w_in dt) x]), V1 = V +
/// C (dv + dtheta x dv/2) + (g - (2w_ie + w_en) x V) dt, gravity proportional to 1 - 2h/a, the rate
/// of the longitude with the radius of the circle of latitude at the end. Requires dt > 0.
MechanizationStep mechanize_one_sample(const NavState& nav, const ImuIncrement& imu);

/// A step of the given kind; only two_sample uses `previous`.
MechanizationStep mechanize(Mechanization kind, const NavState& nav, const ImuIncrement& previous,
                            const ImuIncrement& imu);

}  // namespace canhil::strapdown
