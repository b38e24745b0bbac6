#include "tests/fifth_estimator/vertical_channel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace canhil::baro_inertial {
namespace {

constexpr double g = 9.80665, radius = 6'371'000;

// The increments of a level IMU that is at rest on the equator, at height 0 above the ellipsoid.
strapdown::ImuIncrement at_rest(double dt) {
  constexpr double earth_rate = 7.292115e-5, gravity_of_equator = 9.7803253359;
  return {.delta_theta = {earth_rate * dt, 0, 0}, .delta_v = {0, 0, -gravity_of_equator * dt}, .dt = dt};
}

// Without aiding, a height error grows in proportion to cosh(sqrt(2 g / R) t). Both the error of the INS and
// the sigma in the covariance must grow by this factor.
TEST(VerticalChannel, DivergesWithoutAidAsGravitySays) {
  VerticalChannel channel;
  const Settings settings{.height_sigma_0 = 100};
  channel.start({.height = 100}, settings);
  constexpr double dt = 0.01, end_s = 600;
  for (int i = 0; i < std::lround(end_s / dt); ++i) channel.propagate(at_rest(dt), settings);
  const double growth = std::cosh(std::sqrt(2 * g / radius) * end_s);
  EXPECT_NEAR(std::sqrt(channel.P()(0, 0)) / 100, growth, 1e-4);
  EXPECT_NEAR(channel.nav().height / 100, growth, 0.01);
}

// The filter estimates the accelerometer bias from the heights. The test checks sign and size of all three
// errors.
TEST(VerticalChannel, FindsTheBias) {
  VerticalChannel channel;
  const Settings settings{
      .accel_bias_sigma_0 = 0.01, .height_sigma_0 = 10, .velocity_sigma_0 = 1, .barometer_sigma = 0.1};
  channel.start({.v_eb_n = {0, 0, 0.5}, .height = 5}, settings);
  constexpr double bias = 0.02, dt = 0.01;
  strapdown::ImuIncrement imu = at_rest(dt);
  imu.delta_v.z() += bias * dt;
  for (int i = 1; i <= 6000; ++i) {
    channel.propagate(imu, settings);
    if (i % 10 == 0) {
      EXPECT_EQ(channel.update(0, settings), Outcome::used);
    }
  }
  EXPECT_NEAR(channel.nav().height, 0, 0.01);
  EXPECT_NEAR(channel.nav().v_eb_n.z(), 0, 0.005);
  EXPECT_NEAR(channel.bias(), bias, 2e-4);
}

TEST(VerticalChannel, GatesWhatItDoesNotBelieve) {
  VerticalChannel channel;
  const Settings settings{.height_sigma_0 = 1, .barometer_sigma = 1, .gate = 9};
  channel.start({.height = 0}, settings);
  EXPECT_EQ(channel.update(5, settings), Outcome::gated);
  EXPECT_EQ(channel.nav().height, 0);
  EXPECT_NEAR(channel.nis(), 12.5, 1e-12);
  EXPECT_EQ(channel.update(3, settings), Outcome::used);
  EXPECT_NEAR(channel.nav().height, 1.5, 1e-12);
}

}  // namespace
}  // namespace canhil::baro_inertial
