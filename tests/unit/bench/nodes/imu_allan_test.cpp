// The Allan deviation of the IMU against the numbers of its datasheet, over six decades of the averaging
// time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <numbers>
#include <string>

#include "bench/nodes/registry.hpp"
#include "bench/scenario/section.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "tests/unit/bench/nodes/allan_deviation.hpp"

namespace canhil::sensors {
namespace {

constexpr double dt = 0.01;
#ifdef CANHIL_SANITIZED
constexpr std::int64_t samples = 200'000;
#else
constexpr std::int64_t samples = 10'000'000;  // 28 hours
#endif
/// Of the whole test: that a correct IMU fails it. Each of the points has an equal share.
constexpr double false_alarm = 1e-3;

// Each axis has another combination of errors.
constexpr std::string_view scenario_text = R"(
period_ms = 10
gyro_noise_degprth = [0.1, 0.1, 0.2]
gyro_bias_instability_degph = [0, 2, 1]
gyro_bias_correlation_s = 100
gyro_rate_random_walk_degphprth = [10, 0, 5]
gyro_pulse_urad = 4
accel_noise_ugprthz = [50, 50, 100]
accel_bias_instability_ug = [0, 20, 10]
accel_bias_correlation_s = 300
accel_random_walk_ugprth = [100, 0, 50]
)";
// The same in SI, by hand: 1 deg/sqrt(h) = pi/180/60 rad/sqrt(s), 1 ug/sqrt(h) = 9.80665e-6/60 m/s^2/sqrt(s).
// The largest Allan deviation of a Gauss-Markov process is 0.6174 of its 1-sigma.
constexpr double degprth = std::numbers::pi / 180 / 60, degph = degprth / 60, ug = 9.80665e-6;
const std::array<Datasheet, 6> sheets{{
    {.random_walk = 0.1 * degprth, .rate_random_walk = 10 * degph / 60, .pulse = 4e-6},
    {.random_walk = 0.1 * degprth, .instability = 2 * degph / 0.6174, .time = 100, .pulse = 4e-6},
    {.random_walk = 0.2 * degprth,
     .instability = 1 * degph / 0.6174,
     .time = 100,
     .rate_random_walk = 5 * degph / 60,
     .pulse = 4e-6},
    {.random_walk = 50 * ug, .rate_random_walk = 100 * ug / 60},
    {.random_walk = 50 * ug, .instability = 20 * ug / 0.6174, .time = 300},
    {.random_walk = 100 * ug, .instability = 10 * ug / 0.6174, .time = 300, .rate_random_walk = 50 * ug / 60},
}};
constexpr std::array<std::string_view, 6> names{"gyro_x",  "gyro_y",  "gyro_z",
                                                "accel_x", "accel_y", "accel_z"};

/// The Allan deviations of the six axes of an IMU at rest.
const std::array<std::vector<AllanPoint>, 6>& measured() {
  static const auto all = [] {
    auto section = scenario::Section::parse(scenario_text, "imu.toml");
    const scenario::NodeSettings node = slave_imu.read(nodes::bound(slave_imu).table, section);
    section.finish();
    EXPECT_FALSE(section.error()) << section.error()->message;
    world::ErroneousImu imu(node.own<SlaveImuSettings>()->errors,
                            world::ImuStreams::of("slave_imu", [](const std::string& name) {
                              return world::Stream(1, 0, name);
                            }));
    std::vector<AllanDeviation> axes(6, AllanDeviation(dt));
    for (std::int64_t i = 0; i < samples; ++i) {
      const world::ImuIncrement one = imu.measure({.t_us = 10'000 * (i + 1), .interval_us = 10'000});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        axes[axis].add(one.delta_theta[static_cast<Eigen::Index>(axis)]);
        axes[axis + 3].add(one.delta_v[static_cast<Eigen::Index>(axis)]);
      }
    }
    std::array<std::vector<AllanPoint>, 6> points;
    for (std::size_t axis = 0; axis < axes.size(); ++axis) points[axis] = axes[axis].points(16);
    return points;
  }();
  return all;
}

struct Band {
  double low = 0, high = 0;
};
/// Where the estimated variance is, but for the false alarms: the chi-square distribution of its equivalent
/// degrees of freedom.
Band band_of(const Datasheet& sheet, const AllanPoint& point, std::size_t points) {
  const double freedom = degrees_of_freedom(sheet, point),
               share = false_alarm / static_cast<double>(2 * points);
  const boost::math::chi_squared chi(freedom);
  const double expected = sheet.variance(point.tau);
  return {expected * quantile(chi, share) / freedom, expected * quantile(complement(chi, share)) / freedom};
}

/// How many points of an axis are outside of the band of a datasheet.
int outside(std::size_t axis, const Datasheet& sheet) {
  int count = 0;
  const auto& points = measured()[axis];
  for (const AllanPoint& point : points) {
    const Band band = band_of(sheet, point, 6 * points.size());
    if (point.variance < band.low || point.variance > band.high) ++count;
  }
  return count;
}

// The test can fail: each number of the datasheet, wrong by less than a factor of two.
void expect_wrong_numbers_outside() {
  const auto expect_outside = [](std::size_t axis, double Datasheet::*number, double factor) {
    Datasheet wrong = sheets[axis];
    wrong.*number *= factor;
    EXPECT_GT(outside(axis, wrong), 0) << names[axis] << " times " << factor;
  };
  for (std::size_t axis = 0; axis < sheets.size(); ++axis) {
    for (const double factor : {0.5, 0.98, 1.02, 2.0}) expect_outside(axis, &Datasheet::random_walk, factor);
  }
#ifndef CANHIL_SANITIZED
  for (const std::size_t axis : {0U, 2U, 3U, 5U}) expect_outside(axis, &Datasheet::rate_random_walk, 2);
  for (const std::size_t axis : {1U, 2U, 4U, 5U}) expect_outside(axis, &Datasheet::instability, 2);
  for (const std::size_t axis : {1U, 4U}) expect_outside(axis, &Datasheet::time, 3);
#endif
  for (const std::size_t axis : {0U, 1U, 2U}) expect_outside(axis, &Datasheet::pulse, 1.2);
}

// Both in one test, because each test is a process of its own, and most of the time goes to the samples.
TEST(ImuAllan, IsThatOfTheDatasheetAndOfNoOtherOverSixDecades) {
  for (std::size_t axis = 0; axis < sheets.size(); ++axis) {
    const auto& points = measured()[axis];
#ifndef CANHIL_SANITIZED
    ASSERT_GE(points.back().tau / points.front().tau, 1e6);
#endif
    std::string picture;  // docs/images/allan.py draws it
    for (const AllanPoint& point : points) {
      const Band band = band_of(sheets[axis], point, 6 * points.size());
      EXPECT_GT(point.variance, band.low) << names[axis] << " at " << point.tau << " s";
      EXPECT_LT(point.variance, band.high) << names[axis] << " at " << point.tau << " s";
      picture +=
          fmt::format("{:g} {:.6g} {:.6g} {:.6g} {:.6g}\n", point.tau, std::sqrt(point.variance),
                      std::sqrt(sheets[axis].variance(point.tau)), std::sqrt(band.low), std::sqrt(band.high));
    }
    RecordProperty(std::string(names[axis]), picture);
  }
  expect_wrong_numbers_outside();
}

// The Allan variance that follows from the autocovariance is that of the standard's formulas.
TEST(ImuAllan, AutocovarianceAndVarianceAgree) {
  for (const Datasheet& sheet : sheets) {
    for (double tau = 1; tau < 1e5; tau *= 3) {
      const double mean_square =
          6 * sheet.autocovariance(0) - 8 * sheet.autocovariance(tau) + 2 * sheet.autocovariance(2 * tau);
      EXPECT_NEAR(mean_square / (2 * tau * tau) / sheet.variance(tau), 1, 1e-6) << tau;
    }
  }
}

// Stein's approximations for one kind of noise (Howe, Allan, Barnes: Properties of signal sources and
// measurement methods, 1981, table 1; n angles, m for each tau): white noise of the angle, of the rate,
// random walk of the rate. They are within 8 % of the exact sums.
TEST(ImuAllan, DegreesOfFreedomAreThoseOfStein) {
  for (const std::int64_t count : {100, 1000, 100'000}) {
    const AllanPoint point{.tau = 8, .variance = 1, .m = 8, .terms = count - 16};
    const auto n = static_cast<double>(count), m = 8.0;
    EXPECT_NEAR(degrees_of_freedom({.pulse = 1}, point) / ((n + 1) * (n - 2 * m) / (2 * (n - m))), 1, 0.1);
    EXPECT_NEAR(degrees_of_freedom({.random_walk = 1}, point) /
                    ((3 * (n - 1) / (2 * m) - 2 * (n - 2) / n) * 4 * m * m / (4 * m * m + 5)),
                1, 0.1);
    EXPECT_NEAR(degrees_of_freedom({.rate_random_walk = 1}, point) /
                    ((n - 2) / m * ((n - 1) * (n - 1) - 3 * m * (n - 1) + 4 * m * m) / ((n - 3) * (n - 3))),
                1, 0.1);
  }
}

}  // namespace
}  // namespace canhil::sensors
