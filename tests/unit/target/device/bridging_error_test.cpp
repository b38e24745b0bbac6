#include "target/device/bridging_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace canhil::target {
namespace {

using strapdown::ImuIncrement;

constexpr double dt = 0.01;

// A vibration of the rate about x [rad/s], and white noise of the specific force along z, at sample k.
ImuIncrement sample(int k, double frequency, std::mt19937_64& random) {
  std::normal_distribution<double> white;
  const double phase = 2 * std::numbers::pi * frequency * dt * k;
  return {.delta_theta = Eigen::Vector3d(0.5 * std::sin(phase), 0, 0.1) * dt,
          .delta_v = Eigen::Vector3d(0, 0, -9.8 + 0.2 * white(random)) * dt,
          .dt = dt};
}

// The mean square of the errors of bridges in 20,000 samples that follow.
TEST(BridgingError, IsThatOfTheBridgesThatFollow) {
  std::mt19937_64 random(45);
  for (const double frequency : {5.0, 17.0}) {
    for (const int missing : {1, 2, 5, 20}) {
      SCOPED_TRACE(frequency);
      SCOPED_TRACE(missing);
      BridgingError error;
      std::vector<ImuIncrement> samples;
      for (int k = 0; k < 20'000; ++k) samples.push_back(sample(k, frequency, random));
      for (int k = 0; k < 128; ++k) error.take(samples[static_cast<std::size_t>(k)]);
      const auto [theta, velocity] =
          error.of_gap(static_cast<std::size_t>(missing), dt, samples[0], samples[1]);
      Eigen::Vector3d theta_squares = Eigen::Vector3d::Zero(), velocity_squares = theta_squares;
      int bridges = 0;
      for (std::size_t k = 0; k + static_cast<std::size_t>(missing) + 1 < samples.size(); ++k, ++bridges) {
        const ImuIncrement &before = samples[k], &after = samples[k + static_cast<std::size_t>(missing) + 1];
        Eigen::Vector3d of_theta = missing / 2.0 * (before.delta_theta + after.delta_theta),
                        of_v = missing / 2.0 * (before.delta_v + after.delta_v);
        for (std::size_t i = 1; i <= static_cast<std::size_t>(missing); ++i) {
          of_theta -= samples[k + i].delta_theta;
          of_v -= samples[k + i].delta_v;
        }
        theta_squares += of_theta.cwiseAbs2();
        velocity_squares += of_v.cwiseAbs2();
      }
      EXPECT_NEAR(std::sqrt(theta.x() * bridges / theta_squares.x()), 1, 0.1);
      EXPECT_NEAR(std::sqrt(velocity.z() * bridges / velocity_squares.z()), 1, 0.5);
      EXPECT_LT(theta.z(), 1e-30) << "a constant rate is bridged without an error";
    }
  }
}

TEST(BridgingError, OfTheFirstSamplesIsTheirDifference) {
  BridgingError error;
  const ImuIncrement before{.delta_theta = {1e-3, 0, 0}, .delta_v = {0, 0, -0.1}, .dt = dt},
      after{.delta_theta = {3e-3, 0, 0}, .delta_v = {0, 0, -0.1}, .dt = dt};
  const auto [theta, velocity] = error.of_gap(4, dt, before, after);
  EXPECT_NEAR(std::sqrt(theta.x()), 4 * 2e-3, 1e-12);
  EXPECT_EQ(velocity, Eigen::Vector3d::Zero());
  for (int k = 0; k < 100; ++k) error.take(before);
  EXPECT_EQ(error.of_gap(4, dt, before, after).first, Eigen::Vector3d::Zero());
  error.reset();
  EXPECT_GT(error.of_gap(4, dt, before, after).first.x(), 0);
}

}  // namespace
}  // namespace canhil::target
