// The sensors of vehicles that canhil.dbc does not carry, against an independent computation of what they
// measure.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "bench/nodes/registry.hpp"
#include "bench/sensors/air_data.hpp"
#include "bench/sensors/depth_gauge.hpp"
#include "bench/sensors/gnss_velocity.hpp"
#include "bench/sensors/magnetometer.hpp"
#include "bench/world/units.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;
using world::units::deg;

constexpr std::int64_t second_us = 1'000'000;

// A turn with a bank: everything changes.
const world::FlightRecord& flight() {
  static const world::FlightRecord record(
      {.start = {.latitude = 50 * deg, .longitude = 8 * deg, .height = 2000},
       .motion =
           world::Spiral{.speed = 60, .heading = 70 * deg, .period = 60, .roll = 20 * deg, .depth = {}}},
      20 * second_us, 10'000);
  return record;
}

template <class Settings>
std::vector<Sample> samples_of(const Kind& kind, Settings settings, std::int64_t period_us = second_us) {
  static const scenario::Scenario any;  // sensors keep a reference to their scenario
  settings.schedule.period_us = period_us;
  const scenario::NodeSettings node(nodes::bound(kind).table, settings);
  const auto sensor = kind.make(node, {.scenario = any, .flight = flight()});
  std::vector<Sample> all;
  while (sensor->due_us() != never_us) all.push_back(sensor->measure());
  return all;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double one : values) sum += one;
  return sum / static_cast<double>(values.size());
}
double sigma(const std::vector<double>& values) {
  double squares = 0;
  for (const double one : values) squares += std::pow(one - mean(values), 2);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

// The velocity of the antenna is the derivative of its position.
TEST(GnssVelocity, IsThatOfTheAntenna) {
  const Vector3 lever(2, -3, 1.5);
  const auto place = [&](std::int64_t t_us) {
    const world::Truth at = flight().at(t_us);
    return world::displaced(at.position, at.C_bn * lever);
  };
  constexpr std::int64_t step_us = 10'000;
  for (const Sample& one : samples_of(gnss_velocity, GnssVelocitySettings{.lever_arm = lever})) {
    if (one.valid_us + step_us > flight().end_us()) break;
    const Vector3 way = world::displacement_n(place(one.valid_us - step_us), place(one.valid_us + step_us));
    const Vector3 v = way / (2e-6 * static_cast<double>(step_us));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(one.values[static_cast<std::size_t>(i)], v(i), 2e-3);
    EXPECT_NEAR(one.values[3], v.head<2>().norm(), 2e-3);
    EXPECT_NEAR(std::remainder(one.values[4] - std::atan2(v.y(), v.x()), 2 * std::numbers::pi), 0, 1e-4);
  }
}

TEST(GnssVelocity, HasTheErrorsThatItIsGiven) {
  GnssVelocitySettings settings{.bias = {.value = Vector3(0.5, 0, 0)}};
  settings.correlated = 0.2;
  settings.correlation_s = 0.1;  // short: the samples are nearly independent
  settings.noise = Vector3::Constant(0.1);
  std::vector<double> north, down;
  for (const Sample& one : samples_of(gnss_velocity, settings, 10'000)) {
    north.push_back(one.values[0] - flight().at(one.valid_us).v_eb_n.x());
    down.push_back(one.values[2] - flight().at(one.valid_us).v_eb_n.z());
  }
  ASSERT_EQ(north.size(), 2000U);
  // 2000 samples with a correlation of 10 samples: about 200 independent ones. Three sigma of the estimates.
  EXPECT_NEAR(mean(north), 0.5, 3 * 0.2236 / std::sqrt(200.0));
  EXPECT_NEAR(mean(down), 0, 3 * 0.2236 / std::sqrt(200.0));
  EXPECT_NEAR(sigma(north), 0.2236, 3 * 0.2236 / std::sqrt(2 * 200.0));
}

TEST(GnssVelocity, WithoutASolutionIsInvalid) {
  GnssVelocitySettings settings;
  settings.invalid_probability = 1;
  for (const Sample& one : samples_of(gnss_velocity, settings)) {
    EXPECT_EQ(one.invalid, 1U);
    EXPECT_EQ(one.values[3], 0);
  }
}

// The table of ISO 2533 (geopotential height, temperature [K], pressure [Pa]).
TEST(StandardAir, IsThatOfTheTable) {
  constexpr std::array<std::array<double, 3>, 6> table{{{-1000, 294.65, 113'929},
                                                        {0, 288.15, 101'325},
                                                        {5000, 255.65, 54'019.9},
                                                        {11'000, 216.65, 22'632.0},
                                                        {15'000, 216.65, 12'044.5},
                                                        {20'000, 216.65, 5'474.87}}};
  for (const auto& [height, temperature, pressure] : table) {
    const StandardAir air = standard_air(height);
    EXPECT_NEAR(air.temperature, temperature, 1e-9);
    EXPECT_NEAR(air.pressure, pressure, 1e-5 * pressure);
    EXPECT_NEAR(pressure_altitude(air.pressure), height, 1e-6);
  }
}

TEST(AirData, SeesTheFlowOfTheWind) {
  AirDataSettings settings;
  settings.wind = Vector3(10, -5, 1);
  settings.sea_level_pressure = 100'000;
  settings.temperature_offset = 15;
  for (const Sample& one : samples_of(air_data, settings)) {
    const world::Truth at = flight().at(one.valid_us);
    const Vector3 over_air = at.v_eb_n - settings.wind;
    EXPECT_NEAR(one.values[0], standard_air(at.position.height).pressure / 1.01325, 1e-6);
    EXPECT_NEAR(one.values[1], 288.15 - 0.0065 * at.position.height + 15, 1e-9);
    EXPECT_NEAR(standard_air(one.values[2]).pressure, one.values[0], 1e-6);
    EXPECT_NEAR(one.values[3], over_air.norm(), 1e-12);
    // Turning the x axis by sideslip and angle of attack gives the direction of the flow.
    const Vector3 direction =
        at.C_bn * (Eigen::AngleAxisd(-one.values[4], Vector3::UnitY()) *
                   Eigen::AngleAxisd(one.values[5], Vector3::UnitZ()) * Vector3::UnitX());
    EXPECT_NEAR((direction - over_air.normalized()).norm(), 0, 1e-12);
  }
}

TEST(AirData, ErrorsOfPressureAreErrorsOfTheAltitude) {
  AirDataSettings settings;
  settings.pressure_bias = {.value = 100};
  const Sample with = samples_of(air_data, settings).front(),
               without = samples_of(air_data, AirDataSettings{}).front();
  EXPECT_NEAR(with.values[0] - without.values[0], 100, 1e-9);
  // dh = -dp / (rho g), with the density of the air at 2000 m.
  EXPECT_NEAR(with.values[2] - without.values[2], -100 / (1.00655 * 9.80665), 0.1);
}

TEST(Magnetometer, MeasuresTheFieldInBodyAxes) {
  MagnetometerSettings settings;
  settings.field_n = Vector3(19e-6, 1e-6, 44e-6);
  const double declination = std::atan2(1.0, 19.0);
  for (const Sample& one : samples_of(magnetometer, settings)) {
    const world::Truth at = flight().at(one.valid_us);
    const Vector3 field(one.values[0], one.values[1], one.values[2]);
    EXPECT_NEAR((at.C_bn * field - settings.field_n).norm(), 0, 1e-18);
    EXPECT_NEAR(std::remainder(one.values[3] + declination - world::euler_from(at.C_bn).heading,
                               2 * std::numbers::pi),
                0, 1e-12);
  }
}

// An iron part turns the heading by the angle whose sine is its field across the heading over the horizontal
// field.
TEST(Magnetometer, IronTurnsTheHeading) {
  MagnetometerSettings settings;
  settings.field_n = Vector3(20e-6, 0, 0);
  const double before = samples_of(magnetometer, settings).front().values[3];
  settings.hard_iron.value = Vector3(1e-6, 0, 0);
  const double after = samples_of(magnetometer, settings).front().values[3];
  EXPECT_NEAR(std::abs(after - before), std::abs(std::sin(before)) / 20, 0.1 / 20);
  EXPECT_GT(std::abs(after - before), 0.5 / 20);
}

TEST(DepthGauge, IsBelowTheSurface) {
  DepthGaugeSettings settings;
  settings.surface_height = 2500;
  settings.below = 2;
  settings.scale_factor = {.value = 0.01};
  settings.bias = {.value = 0.3};
  for (const Sample& one : samples_of(depth_gauge, settings)) {
    const world::Truth at = flight().at(one.valid_us);
    const Vector3 gauge_n = at.C_bn * Vector3(0, 0, 2);
    EXPECT_NEAR(one.values[0], 1.01 * (2500 - (at.position.height - gauge_n.z())) + 0.3, 1e-9);
  }
}

}  // namespace
}  // namespace canhil::sensors
