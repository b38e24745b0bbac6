#include "tests/fifth_estimator/vertical_channel.hpp"

namespace canhil::baro_inertial {
namespace {

constexpr double gravity = 9.80665, earth_radius = 6'371'000;
constexpr int height_error = 0, velocity_error = 1, bias_error = 2;

}  // namespace

void VerticalChannel::start(const strapdown::NavState& nav, const Settings& settings) {
  nav_ = nav;
  before_ = {};
  bias_ = nis_ = 0;
  const Eigen::Vector3d sigma(settings.height_sigma_0, settings.velocity_sigma_0,
                              settings.accel_bias_sigma_0);
  P_ = sigma.cwiseAbs2().asDiagonal();
}

void VerticalChannel::propagate(const strapdown::ImuIncrement& imu, const Settings& settings) {
  strapdown::ImuIncrement corrected = imu;
  corrected.delta_v.z() -= bias_ * imu.dt;
  const double down_of_z = nav_.C_bn(2, 2);
  nav_ = strapdown::mechanize_two_sample(nav_, before_, corrected).nav;
  before_ = corrected;

  Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
  F(height_error, velocity_error) = -1;
  F(velocity_error, height_error) = -2 * gravity / earth_radius;
  F(velocity_error, bias_error) = -down_of_z;
  const Eigen::Matrix3d Phi = Eigen::Matrix3d::Identity() + F * imu.dt + F * F * (imu.dt * imu.dt / 2);
  P_ = Phi * P_ * Phi.transpose();
  P_(velocity_error, velocity_error) += settings.accel_noise_density * settings.accel_noise_density * imu.dt;
}

Outcome VerticalChannel::update(double height, const Settings& settings) {
  const double R = settings.barometer_sigma * settings.barometer_sigma;
  const double innovation = nav_.height - height;  // estimated minus measured height: a measurement of dh
  const double S = P_(height_error, height_error) + R;
  nis_ = innovation * innovation / S;
  if (settings.gate > 0 && nis_ > settings.gate) return Outcome::gated;
  const Eigen::Vector3d K = P_.col(height_error) / S;
  nav_.height -= K(height_error) * innovation;
  nav_.v_eb_n.z() -= K(velocity_error) * innovation;
  bias_ -= K(bias_error) * innovation;
  // With Joseph's form, P stays symmetric and positive definite in spite of rounding errors.
  Eigen::Matrix3d left = Eigen::Matrix3d::Identity();
  left.col(height_error) -= K;
  P_ = left * P_ * left.transpose() + K * R * K.transpose();
  return Outcome::used;
}

}  // namespace canhil::baro_inertial
