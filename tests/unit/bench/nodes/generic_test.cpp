// A sensor whose values are expressions: each of its errors against an independent computation.
#include "bench/sensors/generic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "bench/nodes/registry.hpp"
#include "bench/sensors/registry.hpp"
#include "bench/world/units.hpp"

namespace canhil::sensors {
namespace {

constexpr std::int64_t second_us = 1'000'000, period_us = 10'000;

const world::FlightRecord& flight() {
  static const world::FlightRecord record(
      {.start = {},
       .motion = world::LevelAcceleration{.speed = 0, .cruise_us = 5 * second_us, .acceleration = 1}},
      200 * second_us, 100'000);
  return record;
}

GenericValue value_of(const std::string& truth) {
  return {.truth = scenario::Expression::parse(truth).value()};
}

// The samples of a sensor with one value. `run`: its index, on which the random numbers depend. `count`: the
// largest number of samples.
std::vector<Sample> samples_of(const GenericValue& value, std::uint64_t run = 0,
                               std::size_t count = SIZE_MAX) {
  static const scenario::Scenario any;  // sensors keep a reference to their scenario
  const Kind& kind = declared("it", {{.name = "value", .si = "m"}});
  GenericSettings settings{.values = {value}};
  settings.schedule.period_us = period_us;
  const scenario::NodeSettings node(nodes::bound(kind).table, settings);
  const auto sensor = kind.make(node, {.scenario = any, .index = run, .flight = flight()});
  std::vector<Sample> all;
  while (sensor->due_us() != never_us && all.size() < count) all.push_back(sensor->measure());
  return all;
}
std::vector<double> values_of(const GenericValue& value, std::uint64_t run = 0,
                              std::size_t count = SIZE_MAX) {
  std::vector<double> values;
  for (const Sample& one : samples_of(value, run, count)) values.push_back(one.values[0]);
  return values;
}
double mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double one : values) sum += one * one;
  return sum / static_cast<double>(values.size());
}

TEST(Generic, MeasuresItsExpression) {
  const auto samples = samples_of(value_of("2 * t"));
  ASSERT_EQ(samples.size(), 20'000U);
  for (const Sample& one : samples) ASSERT_DOUBLE_EQ(one.values[0], 2e-6 * static_cast<double>(one.valid_us));
}

TEST(Generic, HasConstantErrors) {
  GenericValue value = value_of("3");
  value.bias = {.value = 0.5};
  value.scale_factor = {.value = 0.01};
  for (const double one : values_of(value)) ASSERT_DOUBLE_EQ(one, 3.53);
  // Drawn for each run: 3 sigma of the estimate of a sigma from 200 runs.
  value.bias = {.sigma = 2};
  value.scale_factor = {};
  std::vector<double> biases;
  for (std::uint64_t run = 0; run < 200; ++run) biases.push_back(values_of(value, run, 1).front() - 3);
  EXPECT_NEAR(std::sqrt(mean_square(biases)), 2, 3 * 2 / std::sqrt(2 * 200.0));
}

TEST(Generic, HasWhiteNoise) {
  GenericValue value = value_of("0");
  value.noise = 0.3;
  const auto values = values_of(value);
  EXPECT_NEAR(std::sqrt(mean_square(values)), 0.3, 3 * 0.3 / std::sqrt(2.0 * 20'000));
  double products = 0;
  for (std::size_t i = 1; i < values.size(); ++i) products += values[i] * values[i - 1];
  EXPECT_NEAR(products / 20'000 / 0.09, 0, 3 / std::sqrt(20'000.0));
}

// The correlation of a Gauss-Markov process falls as exp(-tau / T).
TEST(Generic, HasCorrelatedErrors) {
  GenericValue value = value_of("0");
  value.stack.correlated = 0.3;
  value.stack.correlation_s = 0.2;
  const auto values = values_of(value);
  const double independent = 200 / (2 * 0.2);  // number of independent values
  EXPECT_NEAR(std::sqrt(mean_square(values)), 0.3, 3 * 0.3 / std::sqrt(2 * independent));
  for (const std::size_t lag : {10U, 20U, 40U}) {
    double products = 0;
    for (std::size_t i = lag; i < values.size(); ++i) products += values[i] * values[i - lag];
    const double tau = 0.01 * static_cast<double>(lag);
    EXPECT_NEAR(products / 20'000 / mean_square(values), std::exp(-tau / 0.2), 3 / std::sqrt(independent));
  }
}

// The variance of a random walk grows with the time.
TEST(Generic, WalksAtRandom) {
  GenericValue value = value_of("0");
  value.stack.random_walk = 0.1;
  std::vector<double> at_50_s, at_200_s;
  for (std::uint64_t run = 0; run < 100; ++run) {
    const auto values = values_of(value, run);
    at_50_s.push_back(values[4999]);
    at_200_s.push_back(values.back());
  }
  for (const auto& [ends, t] : {std::pair(at_50_s, 50.0), std::pair(at_200_s, 200.0)})
    EXPECT_NEAR(mean_square(ends) / (0.01 * t), 1, 3 * std::sqrt(2.0 / 100));
}

// A lag of the first order follows a ramp late by T = 1 / (2 pi f), once it has settled. The input is taken
// as constant between two samples, dt apart: dt / (e^(dt / T) - 1) = T - dt / 2 + dt^2 / (12 T) - ...
TEST(Generic, Lags) {
  GenericValue value = value_of("5 * t");
  value.stack.bandwidth = 2;
  const auto values = values_of(value);
  const double T = 1 / (2 * std::numbers::pi * 2), dt = 0.01;
  EXPECT_NEAR(5 * 200 - values.back(), 5 * (T - dt / 2 + dt * dt / (12 * T)), 5e-6);
  EXPECT_EQ(values.front(), 0.05) << "it begins settled";
}

TEST(Generic, SaturatesAndHasSteps) {
  GenericValue value = value_of("10 * sin(t)");
  value.stack.lowest = -3;
  value.stack.highest = 4;
  value.stack.step = 0.5;
  for (const Sample& one : samples_of(value)) {
    const double truth = std::clamp(10 * std::sin(1e-6 * static_cast<double>(one.valid_us)), -3.0, 4.0);
    ASSERT_NEAR(one.values[0], truth, 0.25 + 1e-12);
    ASSERT_EQ(std::remainder(one.values[0], 0.5), 0);
  }
}

// At standstill there is no course. The last valid value is held.
TEST(Generic, IsInvalidWithoutTruthOrByItsExpression) {
  GenericValue value = value_of("course + t");
  value.valid = scenario::Expression::parse("t < 100").value();
  double last = 0;
  for (const Sample& one : samples_of(value)) {
    const bool valid = one.valid_us > 5'100'000 && one.valid_us < 100 * second_us;
    if (std::abs(one.valid_us - 5'100'000) < 5000) continue;  // 0.1 m/s is reached here
    ASSERT_EQ(one.invalid, valid ? 0U : 1U) << one.valid_us;
    if (valid) last = one.values[0];
    ASSERT_EQ(one.values[0], last);
  }
}

TEST(Generic, IsOneObjectForOneDeclaration) {
  const Kind& one = declared("it", {{.name = "value", .si = "m"}});
  EXPECT_EQ(&declared("it", {{.name = "value", .si = "m"}}), &one);
  EXPECT_NE(&declared("it", {{.name = "value", .si = "rad"}}), &one);
  EXPECT_EQ(one.key, "it");
  EXPECT_EQ(one.of, &generic);
}

}  // namespace
}  // namespace canhil::sensors
