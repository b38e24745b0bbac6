#include "target/device/bridging_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
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

// Of every `period` samples one is lost, for 95 s.
struct Sum {
  double in_sigmas;              ///< the errors of the bridges about x together, over the sigma of their sum
  double in_independent_sigmas;  ///< the same with the sigma of independent errors
  double variance;               ///< mean variance of a bridge over that of the first
};

Sum sum_of_bridges(int period, double frequency) {
  std::mt19937_64 random(45);
  BridgingError error;
  double sum = 0, variance = 0, first = 0;
  int gaps = 0;
  for (int k = 0; k < 10'000; ++k) {
    const ImuIncrement own = sample(k, frequency, random);
    if (k < 500 || k % period != 2) {
      error.take(own);
      continue;
    }
    const ImuIncrement before = sample(k - 1, frequency, random), after = sample(k + 1, frequency, random);
    const double of_gap = error.of_gap(1, dt, before, after).first.x();
    if (gaps++ == 0) first = of_gap;
    variance += of_gap;
    sum += std::midpoint(before.delta_theta.x(), after.delta_theta.x()) - own.delta_theta.x();
  }
  return {.in_sigmas = std::abs(sum) / std::sqrt(variance),
          .in_independent_sigmas = std::abs(sum) / std::sqrt(gaps * first),
          .variance = variance / (gaps * first)};
}

// 16 samples of 10 ms are two periods of 12.5 Hz and 20 samples two of 10 Hz: each lost sample has the same
// phase. The known errors reach back 1.3 s, and the sum here is of 95 s, so some sigmas are left.
TEST(BridgingError, AddsUpWhereSamplesAreLostInStepWithAVibration) {
  for (const auto& [period, frequency] : {std::pair{16, 12.5}, std::pair{20, 10.0}}) {
    SCOPED_TRACE(period);
    const Sum sum = sum_of_bridges(period, frequency);
    EXPECT_GT(sum.in_independent_sigmas, 25);
    EXPECT_LT(sum.in_sigmas, 13);
  }
}

TEST(BridgingError, AveragesOutWhereTheyAreLostOutOfStep) {
  for (const int period : {17, 23, 33}) {
    SCOPED_TRACE(period);
    const Sum sum = sum_of_bridges(period, 10);
    EXPECT_LT(sum.in_sigmas, 3);
    EXPECT_LT(sum.variance, 1);
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
