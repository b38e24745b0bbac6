// The levels of the noises and biases of the seeker.
#include "bench/sensors/seeker_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/unit/bench/nodes/exact_seeker.hpp"

namespace canhil::sensors {
namespace {

SeekerTruth at(double range) {
  return {.t_us = 5000,
          .interval_us = 5000,
          .range = range,
          .closing_speed = 900,
          .error = {.pitch = 0.01, .yaw = -0.02},
          .delta_theta = {0.01, 2e-4, -3e-4},
          .mean_acceleration = {1, 20, -30}};
}

/// Mean and variance of a number over many samples of one run.
struct Moments {
  double mean = 0, variance = 0;
};
constexpr int samples = 20'000;
Moments moments(const SeekerErrorModel& model, double range,
                const std::function<double(const SeekerMeasurement&)>& number, std::uint64_t run = 0) {
  ErroneousSeeker seeker(model, Stream(1, run, "seeker"));
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    const double x = number(seeker.measure(at(range)));
    sum += x;
    squares += x * x;
  }
  return {.mean = sum / samples, .variance = squares / samples - sum * sum / samples / samples};
}

// Five standard errors of an estimated variance.
void expect_sigma(const Moments& found, double sigma) {
  EXPECT_NEAR(found.variance, sigma * sigma, 5 * sigma * sigma * std::sqrt(2.0 / samples));
}

TEST(ErroneousSeeker, WithoutErrorsIsExact) {
  const SeekerMeasurement m = ErroneousSeeker(exact_seeker, Stream(1, 0, "seeker")).measure(at(2000));
  EXPECT_EQ(m.error, (Planes<double>{.pitch = 0.01, .yaw = -0.02}));
  EXPECT_EQ(m.antenna, at(2000).delta_theta);
  EXPECT_EQ(m.missile_acceleration, (Planes<double>{.pitch = -30, .yaw = 20})) << "z in pitch, y in yaw";
  EXPECT_EQ(m.range, 2000);
  EXPECT_EQ(m.closing_speed, 900);
  EXPECT_TRUE(m.in_view);
  EXPECT_EQ(m.t_us, 5000);
  EXPECT_EQ(m.interval_us, 5000);
}

TEST(ErroneousSeeker, ErrorAnglesHaveThermalGlintAndConstantNoise) {
  const auto pitch = [](const SeekerMeasurement& m) { return m.error.pitch - 0.01; };
  const auto yaw = [](const SeekerMeasurement& m) { return m.error.yaw + 0.02; };
  expect_sigma(moments({}, 5000, pitch), std::hypot(2.5e-3, 1e-4));
  expect_sigma(moments({}, 100, yaw), std::hypot(5e-3, 1e-6));
  SeekerErrorModel constant = exact_seeker;
  constant.constant = 1e-3;
  expect_sigma(moments(constant, 3000, yaw), 1e-3);
}

TEST(ErroneousSeeker, GlintIsWhiteOrCorrelated) {
  for (const double tau : {0.0, 0.04}) {
    SeekerErrorModel model = exact_seeker;
    model.glint = 0.5;
    model.glint_correlation = tau;
    ErroneousSeeker seeker(model, Stream(1, 0, "seeker"));
    double before = 0, product = 0, square = 0;
    constexpr int many = 200'000;
    for (int i = 0; i < many; ++i) {
      const double x = seeker.measure(at(100)).error.pitch - 0.01;
      product += x * before;
      square += x * x;
      before = x;
    }
    const double expected = tau > 0 ? std::exp(-0.005 / tau) : 0;
    EXPECT_NEAR(product / square, expected, 0.01) << tau;
    EXPECT_NEAR(square / many, 25e-6, 25e-6 * 0.05) << "the same variance, whatever tau is";
  }
}

TEST(ErroneousSeeker, GyrosAndAccelerometers) {
  expect_sigma(moments({}, 2000, [](const auto& m) { return m.antenna.y() - 2e-4; }), 5e-6);
  expect_sigma(moments({}, 2000, [](const auto& m) { return m.missile_acceleration.yaw - 20; }), 0.3);
  SeekerErrorModel biased = exact_seeker;
  biased.gyro_bias.value = 1e-3;
  biased.accel_bias.value = 0.5;
  const SeekerMeasurement m = ErroneousSeeker(biased, Stream(1, 0, "seeker")).measure(at(2000));
  EXPECT_NEAR(m.antenna.z(), -3e-4 + 5e-6, 1e-15);
  EXPECT_NEAR(m.missile_acceleration.pitch, -29.5, 1e-12);
}

TEST(ErroneousSeeker, ErrorsOfRangeShrinkWithin1km) {
  const auto range = [](const SeekerMeasurement& m) { return m.range; };
  expect_sigma(moments({}, 4000, range), 5);
  expect_sigma(moments({}, 200, range), 1);
  SeekerErrorModel biased = exact_seeker;
  biased.range_bias.value = -50;
  EXPECT_EQ(moments(biased, 4000, range).mean, 3950);
  EXPECT_NEAR(moments(biased, 200, range).mean, 190, 1e-9);
  expect_sigma(moments({}, 200, [](const SeekerMeasurement& m) { return m.closing_speed; }), 3);
}

TEST(ErroneousSeeker, BiasesAreConstantInARunAndDrawnOverRuns) {
  SeekerErrorModel model = exact_seeker;
  model.closing_speed_bias.sigma = 5;
  double squares = 0;
  for (std::uint64_t run = 0; run < 2000; ++run) {
    ErroneousSeeker seeker(model, Stream(1, run, "seeker"));
    const double bias = seeker.measure(at(2000)).closing_speed - 900;
    ASSERT_EQ(seeker.measure(at(2000)).closing_speed - 900, bias);
    squares += bias * bias;
  }
  EXPECT_NEAR(squares / 2000, 25, 5 * 25 * std::sqrt(2.0 / 2000));
}

TEST(ErroneousSeeker, SeesNothingBeyondItsFieldOfView) {
  SeekerErrorModel model = exact_seeker;
  model.field_of_view = 0.015;
  ErroneousSeeker seeker(model, Stream(1, 0, "seeker"));
  EXPECT_FALSE(seeker.measure(at(2000)).in_view) << "yaw is at -0.02";
  SeekerTruth inside = at(2000);
  inside.error.yaw = -0.0149;
  EXPECT_TRUE(seeker.measure(inside).in_view);
}

}  // namespace
}  // namespace canhil::sensors
