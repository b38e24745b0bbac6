// Sensors of a vehicle that turns: what they measure at their place, with their axes and their times, against
// an independent computation.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "bench/sensors/air_data.hpp"
#include "bench/sensors/depth_gauge.hpp"
#include "bench/sensors/dvl.hpp"
#include "bench/sensors/gps.hpp"
#include "bench/sensors/magnetometer.hpp"
#include "bench/sensors/start.hpp"
#include "bench/sensors/wheels.hpp"
#include "bench/world/units.hpp"
#include "tests/unit/bench/nodes/measured.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;
using world::units::deg;

// A turn with a bank: everything changes.
const world::FlightRecord& turning() {
  static const world::FlightRecord record(
      {.start = {.latitude = 50 * deg, .longitude = 8 * deg, .height = 2000},
       .motion =
           world::Spiral{.speed = 30, .heading = 70 * deg, .period = 30, .roll = 20 * deg, .depth = {}}},
      20'000'000, 10'000);
  return record;
}

Vector3 first_three(const Sample& sample) { return {sample.values[0], sample.values[1], sample.values[2]}; }

// The velocity of the point of the DVL is the derivative of its position.
Vector3 velocity_of_point(const Vector3& lever, std::int64_t t_us) {
  const auto place = [&](std::int64_t at_us) {
    const world::Truth at = turning().at(at_us);
    return world::displaced(at.position, at.C_bn * lever);
  };
  return world::displacement_n(place(t_us - 10'000), place(t_us + 10'000)) / 0.02;
}

TEST(Dvl, MeasuresAlongItsAxesAtItsPlace) {
  const Vector3 lever(2, -3, 1.5);
  const auto samples = measured(dvl,
                                "period_ms = 1000\nlever_arm_m = [2, -3, 1.5]\nmounting_deg = [180, 0, 45]\n"
                                "scale_factor_ppm = 2000\nbias_mps = [0.1, 0.2, -0.3]\n",
                                turning());
  ASSERT_EQ(samples.size(), 20U);
  for (const Sample& one : samples) {
    if (one.valid_us >= turning().end_us()) break;
    const Vector3 body = turning().at(one.valid_us).C_bn.transpose() * velocity_of_point(lever, one.valid_us);
    // Upside down, and its x axis between the body's x and y: y and z point the other way.
    const double r = std::numbers::sqrt2 / 2;
    const Vector3 own(r * body.x() + r * body.y(), r * body.x() - r * body.y(), -body.z());
    EXPECT_LT((first_three(one) - 1.002 * own - Vector3(0.1, 0.2, -0.3)).norm(), 2e-3) << one.valid_us;
  }
}

TEST(Dvl, WithoutBottomLockIsInvalidAndHasItsNoise) {
  int invalid = 0;
  Vector3 squares = Vector3::Zero();
  const auto samples =
      measured(dvl, "period_ms = 10\nnoise_mps = [0.1, 0.2, 0.3]\ninvalid_percent = 10\n", turning());
  for (const Sample& one : samples) {
    const world::Truth at = turning().at(one.valid_us);
    if (one.invalid != 0) {
      ++invalid;
      EXPECT_EQ(first_three(one), Vector3::Zero());
    } else {
      squares += (first_three(one) - at.C_bn.transpose() * at.v_eb_n).cwiseAbs2();
    }
  }
  EXPECT_NEAR(invalid, 200, 5 * std::sqrt(2000 * 0.1 * 0.9));
  const Vector3 sigma = (squares / (2000 - invalid)).cwiseSqrt();
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(sigma[axis], 0.1 * (axis + 1), 0.5 * (axis + 1) / std::sqrt(2 * 1800.0));
}

// Against the sensor without errors. Both draw the same numbers, but those multiply 0.
TEST(AirData, HasTheErrorsOfItsKeys) {
  const std::string sensor = "period_ms = 10\nwind_mps = [3, -2, 0.5]\n";
  const auto exact = measured(air_data, sensor, turning());
  const auto noisy = measured(air_data,
                              sensor +
                                  "pressure_bias_hpa = 2\npressure_noise_hpa = 0.5\nspeed_scale_ppm = 20000\n"
                                  "speed_noise_mps = 0.4\nangle_bias_deg = 1\nangle_noise_deg = 0.2\n",
                              turning());
  ASSERT_EQ(exact.size(), noisy.size());
  const double count = static_cast<double>(exact.size());
  const auto expect = [&](std::size_t value, double scale, double bias, double sigma) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double error = noisy[i].values[value] - scale * exact[i].values[value];
      sum += error;
      squares += (error - bias) * (error - bias);
    }
    // Five sigmas of a mean and of a standard deviation.
    EXPECT_NEAR(sum / count, bias, 5 * sigma / std::sqrt(count)) << value;
    EXPECT_NEAR(std::sqrt(squares / count), sigma, 5 * sigma / std::sqrt(2 * count)) << value;
  };
  expect(0, 1, 200, 50);                          // Pa
  expect(3, 1.02, 0, 0.4);                        // air speed
  expect(4, 1, 1 * deg, 0.2 * deg);               // angle of attack
  expect(5, 1, 1 * deg, 0.2 * deg);               // sideslip
  for (std::size_t i = 0; i < exact.size(); ++i)  // the temperature has no error
    EXPECT_EQ(noisy[i].values[1], exact[i].values[1]);
}

// The wheels of a level turn to the right roll on circles about the same centre: their speeds are as their
// radii.
TEST(Wheels, RollOnCircles) {
  const world::FlightRecord level(
      {.start = {.latitude = 0.8},
       .motion = world::Spiral{.speed = 10, .period = 60, .roll = 0, .depth = {}}},
      5'000'000, 10'000);
  const double radius = 10 * 60 / (2 * std::numbers::pi);
  const auto samples =
      measured(wheels, "period_ms = 20\ntrack_m = 1.6\nscale_factor_ppm = 5000\nwith_sign = true\n", level);
  ASSERT_EQ(samples.size(), 250U);
  for (const Sample& one : samples) {
    const bool to_the_right = level.at(one.valid_us).omega_ib_b.z() > 0;
    const double left = 10 * (radius + (to_the_right ? 0.8 : -0.8)) / radius;
    // The earth turns the vehicle too, by 7e-5 rad/s.
    EXPECT_NEAR(one.values[0], 1.005 * left, 1e-4);
    EXPECT_NEAR(one.values[1], 1.005 * (20 - left), 1e-4);
    EXPECT_EQ(one.values[2], one.values[0]);
    EXPECT_EQ(one.values[3], one.values[1]);
  }
}

TEST(Wheels, CountWithoutASign) {
  const world::FlightRecord back(
      {.start = {}, .motion = world::Spiral{.speed = 5, .period = 1e6, .depth = {}}}, 1'000'000, 10'000);
  for (const Sample& one : measured(wheels, "period_ms = 20\nnoise_mps = 20\n", back))
    for (int i = 0; i < 4; ++i) EXPECT_GE(one.values[static_cast<std::size_t>(i)], 0);
}

// All tellings have the same error, and the sigmas that the device is told.
TEST(Start, TellsTheStateWithOneError) {
  scenario::Scenario scenario;
  scenario.initial_error.heading_magnitude = 0.3;
  const auto samples =
      measured(start, "period_ms = 100\ntimes = 3\nheading_sigma_deg = 20\nposition_sigma_m = 5\n", turning(),
               0, scenario);
  ASSERT_EQ(samples.size(), 3U);
  double first = 0;
  for (const Sample& one : samples) {
    const world::Truth at = turning().at(one.valid_us);
    const double error =
        std::remainder(one.values[8] - world::euler_from(at.C_bn).heading, 2 * std::numbers::pi);
    if (first == 0) first = error;
    EXPECT_NEAR(std::abs(error), 0.3, 1e-12);
    EXPECT_NEAR(error, first, 1e-12);
    EXPECT_EQ(one.values[0], at.position.latitude);
    EXPECT_EQ(one.values[9], 5);
    EXPECT_NEAR(one.values[12], 20 * deg, 1e-15);
  }
  EXPECT_EQ(samples.front().valid_us, 0);
}

TEST(Gps, MeasuresTheAntenna) {
  for (const Sample& one : measured(gps, "period_ms = 1000\nlever_arm_m = [1, 2, -4]\n", turning())) {
    const world::Truth at = turning().at(one.valid_us);
    const Vector3 way = world::displacement_n(
        at.position, {.latitude = one.values[0], .longitude = one.values[2], .height = one.values[1]});
    EXPECT_LT((way - at.C_bn * Vector3(1, 2, -4)).norm(), 1e-5);
  }
}

// A correlated error has its sigma, falls as exp(-tau / T), and is in the reported sigma.
TEST(Gps, HasACorrelatedError) {
  const auto samples = measured(
      gps, "period_ms = 10\nnoise_m = 0.3\ncorrelated_m = [0, 0, 0.4]\ncorrelation_s = 0.05\n", turning());
  std::vector<double> down;
  for (const Sample& one : samples) {
    down.push_back(turning().at(one.valid_us).position.height - one.values[1]);
    EXPECT_NEAR(one.values[4], 0.3, 1e-12);
    EXPECT_NEAR(one.values[5], 0.5, 1e-12);
  }
  double squares = 0, products = 0;
  for (std::size_t i = 5; i < down.size(); ++i) {
    squares += down[i] * down[i];
    products += down[i] * down[i - 5];
  }
  const double count = static_cast<double>(down.size() - 5), independent = count / 10;
  EXPECT_NEAR(squares / count, 0.25, 0.25 * 3 * std::sqrt(2 / independent));
  EXPECT_NEAR(products / count, 0.16 * std::exp(-1.0), 0.25 * 3 / std::sqrt(independent));
}

TEST(Magnetometer, HasSoftIronMountingRangeAndSteps) {
  const std::string field = "field_ut = 50\ninclination_deg = 60\ndeclination_deg = 0\nperiod_ms = 1000\n";
  const auto ideal = measured(magnetometer, field, turning());
  const auto iron = measured(
      magnetometer, field + "soft_iron_percent = [1, 2, -3]\nsoft_iron_cross_percent = [0.5, 0, -0.7]\n",
      turning());
  const auto turned =
      measured(magnetometer, field + "mounting_deg = [0, 0, 90]\nhard_iron_ut = [1, 2, 3]\n", turning());
  const auto coarse = measured(magnetometer, field + "range_ut = 40\nstep_ut = 0.5\n", turning());
  for (std::size_t i = 0; i < ideal.size(); ++i) {
    const Vector3 f = first_three(ideal[i]), c = first_three(coarse[i]);
    const Vector3 soft(1.01 * f.x() + 0.005 * f.y(), 0.005 * f.x() + 1.02 * f.y() - 0.007 * f.z(),
                       -0.007 * f.y() + 0.97 * f.z());
    EXPECT_LT((first_three(iron[i]) - soft).norm(), 1e-18);
    EXPECT_LT((first_three(turned[i]) - Vector3(f.y() + 2e-6, -f.x() - 1e-6, f.z() + 3e-6)).norm(), 1e-18);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(c[axis], std::round(std::clamp(f[axis], -40e-6, 40e-6) / 0.5e-6) * 0.5e-6, 1e-18);
  }
}

// Latencies are equally distributed between their limits; the order of the samples is kept; the time of
// validity is not changed.
TEST(Schedule, LatencySpreads) {
  auto section =
      scenario::Section::parse("period_ms = 100\nlatency_ms = 20\nlatency_spread_ms = 60\n", "s.toml");
  const NodeSettings node = depth_gauge.read(nodes::bound(depth_gauge).table, section);
  EXPECT_EQ(node.latency_us(), 80'000);
  const scenario::Scenario scenario;
  const auto sensor = depth_gauge.make(node, {.scenario = scenario, .flight = turning()});
  double sum = 0, least = HUGE_VAL, most = 0;
  int count = 0;
  for (std::int64_t last_us = 0; sensor->due_us() != never_us; ++count) {
    const std::int64_t due_us = sensor->due_us();
    EXPECT_GE(due_us, last_us);
    last_us = due_us;
    const Sample one = sensor->measure();
    EXPECT_EQ(one.valid_us, 100'000 * (count + 1));
    EXPECT_EQ(one.stamp_us, one.valid_us);
    const double latency = 1e-6 * static_cast<double>(due_us - one.valid_us);
    sum += latency;
    least = std::min(least, latency);
    most = std::max(most, latency);
  }
  EXPECT_GE(count, 199);
  EXPECT_GE(least, 0.02);
  EXPECT_LE(most, 0.08);
  EXPECT_NEAR(sum / count, 0.05, 5 * 0.06 / std::sqrt(12.0 * count));
  EXPECT_GT(most - least, 0.05);
}

// Latencies that are much longer than the period never change the order.
TEST(Schedule, LongLatenciesKeepTheOrder) {
  std::int64_t last_us = 0;
  for (const Sample& one : measured(depth_gauge, "period_ms = 10\nlatency_spread_ms = 500\n", turning())) {
    EXPECT_EQ(one.valid_us, last_us + 10'000);
    last_us = one.valid_us;
  }
}

// A position that is taken early or late is wrong by the velocity times the jitter.
TEST(Schedule, JitterMovesTheTruth) {
  double squares = 0;
  int count = 0;
  for (const Sample& one : measured(gps, "period_ms = 20\nsampling_jitter_us = 500\n", turning())) {
    const world::Truth at = turning().at(one.valid_us);
    const Vector3 way = world::displacement_n(
        at.position, {.latitude = one.values[0], .longitude = one.values[2], .height = one.values[1]});
    const double along = way.dot(at.v_eb_n.normalized());
    EXPECT_LT((way - along * at.v_eb_n.normalized()).norm(), 1e-4);
    squares += std::pow(along / at.v_eb_n.norm(), 2);
    ++count;
  }
  EXPECT_NEAR(std::sqrt(squares / count), 500e-6, 3 * 500e-6 / std::sqrt(2.0 * count));
}

}  // namespace
}  // namespace canhil::sensors
