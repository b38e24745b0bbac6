// Each error of the stack against an independent computation.
#include "bench/world/error_stack.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "bench/world/mounting.hpp"

namespace canhil::world {
namespace {

constexpr double sample_s = 0.01;

// A Butterworth low pass, integrated in small steps by the method of Runge and Kutta.
double reference(double bandwidth, double input, double& output, double& slope) {
  const double w = 2 * std::numbers::pi * bandwidth, h = sample_s / 100;
  const auto slopes = [&](double y, double v) {
    return std::pair(v, w * w * (input - y) - std::numbers::sqrt2 * w * v);
  };
  for (int i = 0; i < 100; ++i) {
    const auto [y1, v1] = slopes(output, slope);
    const auto [y2, v2] = slopes(output + h / 2 * y1, slope + h / 2 * v1);
    const auto [y3, v3] = slopes(output + h / 2 * y2, slope + h / 2 * v2);
    const auto [y4, v4] = slopes(output + h * y3, slope + h * v3);
    output += h / 6 * (y1 + 2 * y2 + 2 * y3 + y4);
    slope += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
  }
  return output;
}

TEST(Lag, OfTheSecondOrderIsAButterworthLowPass) {
  Lag lag({.bandwidth = 8, .order = 2}, sample_s);
  double output = 0, slope = 0;
  EXPECT_EQ(lag.next(0), 0);
  for (int i = 1; i < 200; ++i) {
    const double input = i < 100 ? 1 : std::sin(0.3 * i);
    EXPECT_NEAR(lag.next(input), reference(8, input, output, slope), 1e-8) << i;
  }
}

// At the bandwidth, the amplitude is 1/sqrt(2) for both orders. 200 samples per period: the steps of the
// input hardly matter.
TEST(Lag, HalvesThePowerAtItsBandwidth) {
  for (const std::int64_t order : {1, 2}) {
    Lag lag({.bandwidth = 0.5, .order = order}, sample_s);
    double highest = 0;
    for (int i = 0; i < 4000; ++i) {
      const double output = lag.next(std::sin(2 * std::numbers::pi * 0.5 * sample_s * i));
      if (i > 2000) highest = std::max(highest, output);
    }
    EXPECT_NEAR(highest, 1 / std::numbers::sqrt2, 2e-3) << order;
  }
}

TEST(ErrorStack, SaturatesAndSaysSo) {
  Stream stream(1, 0, "it");
  AxisErrors axis({.lowest = -2, .highest = 3}, sample_s, stream);
  EXPECT_EQ(axis.given(2.5), 2.5);
  EXPECT_FALSE(axis.is_saturated());
  EXPECT_EQ(axis.given(4), 3);
  EXPECT_TRUE(axis.is_saturated());
  EXPECT_EQ(axis.given(-4), -2);
  EXPECT_TRUE(axis.is_saturated());
  EXPECT_EQ(axis.given(0), 0);
  EXPECT_FALSE(axis.is_saturated());
}

// A step loses what does not fill it; the counts of an integrator add up to the integral.
TEST(ErrorStack, StepsLoseAndPulsesKeepTheRemainder) {
  Stream stream(1, 0, "it");
  AxisErrors steps({.step = 0.5}, sample_s, stream), pulses({.pulse = 0.02}, sample_s, stream);
  double integral = 0, counted = 0;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(steps.given(0.2), 0);
    EXPECT_EQ(steps.given(0.3), 0.5);
    const double value = 0.7 + 0.6 * std::sin(0.1 * i), given = pulses.given(value);
    integral += value * sample_s;
    counted += given * sample_s;
    EXPECT_NEAR(given * sample_s, 0.02 * std::round(given * sample_s / 0.02), 1e-12);
    EXPECT_LE(std::abs(counted - integral), 0.01 + 1e-12);
  }
}

TEST(ErrorStack, WithoutErrorsChangesNoBit) {
  TriadErrors none({}, sample_s, Stream(1, 0, "it"));
  EXPECT_TRUE(none.is_ideal());
  const Vector3 value(0.1, 1.0 / 3, -7e-9);
  EXPECT_EQ(none.lag(value), value);
  EXPECT_EQ(none.wander(), Vector3::Zero());
  EXPECT_EQ(none.given(value), value);
}

TEST(ErrorStack, AxesAreIndependent) {
  TriadErrors::Stacks stacks{};
  for (ErrorStack& stack : stacks) stack.random_walk = 1;
  TriadErrors triad(stacks, 1, Stream(1, 0, "it"));
  Vector3 last = triad.wander();
  Matrix3 products = Matrix3::Zero();
  constexpr int count = 20'000;
  for (int i = 0; i < count; ++i) {
    const Vector3 now = triad.wander(), step = now - last;
    products += step * step.transpose() / count;
    last = now;
  }
  EXPECT_LT((products - Matrix3::Identity()).cwiseAbs().maxCoeff(), 5 * std::sqrt(2.0 / count));
}

// The acceleration of a point of a body that swings about z, in body axes: -omega^2 r along the lever arm,
// and d(omega)/sample_s r across it. The integral over the interval is added up in small steps.
TEST(LeverArm, MeasuresEulerAndCentripetalAcceleration) {
  const auto rate = [](double t) { return 2 * std::cos(5 * t); };
  constexpr double r = 0.4, t0 = 0.3;
  ImuIncrement still{.interval_us = 10'000};
  double centripetal = 0, euler = 0, angle = 0;
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i) {
    const double t = t0 + (i + 0.5) * sample_s / steps;
    centripetal -= rate(t) * rate(t) * r * sample_s / steps;
    euler += -10 * std::sin(5 * t) * r * sample_s / steps;
    angle += rate(t) * sample_s / steps;
  }
  still.delta_theta.z() = angle;
  const ImuIncrement at = increment_at(still, {r, 0, 0.7}, {0, 0, rate(t0)}, {0, 0, rate(t0 + sample_s)});
  EXPECT_NEAR(at.delta_v.x(), centripetal, 1e-8);
  EXPECT_NEAR(at.delta_v.y(), euler, 1e-8);
  EXPECT_EQ(at.delta_v.z(), 0);
  EXPECT_EQ(at.delta_theta, still.delta_theta);
}

}  // namespace
}  // namespace canhil::world
