// The keys of the IMU's errors, from the numbers of a datasheet to its samples: each against a computation by
// hand. The units are converted here by hand too.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "bench/sensors/slave_imu.hpp"
#include "tests/unit/bench/nodes/measured.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;

constexpr double deg = std::numbers::pi / 180, degph = deg / 3600, g0 = 9.80665, dt = 0.01;

// A turn with a bank, and pitching: rates and forces about all axes.
const world::FlightRecord& flight() {
  static const world::FlightRecord record({.start = {.latitude = 0.8, .longitude = 0.1, .height = 2000},
                                           .motion = world::Weave{.heading = 1,
                                                                  .speed = 60,
                                                                  .heading_amplitude = 0.5,
                                                                  .turn_period = 9,
                                                                  .pitch_amplitude = 0.3,
                                                                  .pitch_period = 5}},
                                          20'000'000, 10'000);
  return record;
}

struct Imu {
  std::vector<Vector3> theta, v;
  std::vector<Sample> samples;
};
Imu imu(const std::string& keys = "", std::uint64_t run = 0) {
  Imu made{.theta = {}, .v = {}, .samples = measured(slave_imu, "period_ms = 10\n" + keys, flight(), run)};
  for (const Sample& one : made.samples) {
    made.theta.emplace_back(one.values[0], one.values[1], one.values[2]);
    made.v.emplace_back(one.values[3], one.values[4], one.values[5]);
  }
  return made;
}
const Imu& ideal() {
  static const Imu one = imu();
  return one;
}
// The largest difference of two series.
double apart(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double largest = a.size() == b.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, (a[i] - b[i]).cwiseAbs().maxCoeff());
  return largest;
}
std::vector<Vector3> each(const std::vector<Vector3>& of,
                          const std::function<Vector3(const Vector3&)>& change) {
  std::vector<Vector3> all;
  for (const Vector3& one : of) all.push_back(change(one));
  return all;
}

TEST(ImuErrors, MountingTurnsTheAxes) {
  const Imu turned = imu("mounting_deg = [0, 0, 90]\n");  // its x axis points to the body's y axis
  const auto turn = [](const Vector3& x) { return Vector3(x.y(), -x.x(), x.z()); };
  EXPECT_LT(apart(turned.theta, each(ideal().theta, turn)), 1e-15);
  EXPECT_LT(apart(turned.v, each(ideal().v, turn)), 1e-15);
}

TEST(ImuErrors, DrawnMountingHasItsSigma) {
  Vector3 squares = Vector3::Zero();
  for (std::uint64_t run = 0; run < 100; ++run) {
    const auto one = imu("mounting_sigma_deg = 0.1\n", run).v.front();
    squares += one.cross(ideal().v.front()).cwiseAbs2() / 100;
  }
  // A small turn phi changes v by v x phi: |v x phi x v| is |v|^2 phi across v.
  const double across = std::sqrt(squares.sum()) / ideal().v.front().squaredNorm();
  EXPECT_NEAR(across / (std::sqrt(2.0) * 0.1 * deg), 1, 0.25);
}

TEST(ImuErrors, NonOrthogonalityMixesAxes) {
  const Imu skewed =
      imu("gyro_nonorthogonality_mrad = [1, 2, 3]\naccel_nonorthogonality_mrad = [0, 0, -4]\n");
  EXPECT_LT(apart(skewed.theta, each(ideal().theta,
                                     [](const Vector3& x) {
                                       return Vector3(x.x(), x.y() + 1e-3 * x.x(),
                                                      x.z() + 2e-3 * x.x() + 3e-3 * x.y());
                                     })),
            1e-15);
  EXPECT_LT(
      apart(skewed.v,
            each(ideal().v, [](const Vector3& x) { return Vector3(x.x(), x.y(), x.z() - 4e-3 * x.y()); })),
      1e-15);
}

TEST(ImuErrors, GSensitivityIsInProportionToTheForce) {
  const Imu sensitive = imu("gyro_g_sensitivity_degph_per_g = [10, 0, -20]\n");
  for (std::size_t i = 0; i < ideal().theta.size(); ++i) {
    const Vector3 error = sensitive.theta[i] - ideal().theta[i], v = ideal().v[i];
    ASSERT_NEAR(error.x(), 10 * degph * v.x() / g0, 1e-15);
    ASSERT_NEAR(error.y(), 0, 1e-15);
    ASSERT_NEAR(error.z(), -20 * degph * v.z() / g0, 1e-15);
  }
  EXPECT_EQ(apart(sensitive.v, ideal().v), 0);
  // Drawn: nine independent terms; the error of an axis has the sigma of one term times the length of the
  // force.
  double squares = 0;
  const Vector3 v = ideal().v.front();
  for (std::uint64_t run = 0; run < 200; ++run)
    squares += (imu("gyro_g_sensitivity_sigma_degph_per_g = 5\n", run).theta.front() - ideal().theta.front())
                   .squaredNorm();
  EXPECT_NEAR(std::sqrt(squares / 600) / (5 * degph * v.norm() / g0), 1, 3 / std::sqrt(2 * 600.0));
}

TEST(ImuErrors, TemperatureChangesBiasAndScale) {
  const Imu warm =
      imu("temperature_degc = 5\nwarm_up_k = 40\nwarm_up_time_s = 8\ngyro_bias_degph_per_k = [2, 0, 0]\n"
          "accel_bias_ug_per_k2 = [0, 3, 0]\naccel_scale_factor_ppm_per_k = [0, 0, 10]\n");
  for (std::size_t i = 0; i < ideal().theta.size(); ++i) {
    const double temperature = 5 + 40 * (1 - std::exp(-dt * static_cast<double>(i + 1) / 8)),
                 dT = temperature - 25;
    ASSERT_NEAR(warm.samples[i].values[6], temperature, 1e-9);
    const Vector3 theta = warm.theta[i] - ideal().theta[i], v = warm.v[i] - ideal().v[i];
    ASSERT_NEAR(theta.x(), 2 * degph * dT * dt, 1e-15);
    ASSERT_NEAR(v.y(), 3e-6 * g0 * dT * dT * dt, 1e-14);
    ASSERT_NEAR(v.z(), 1e-5 * dT * ideal().v[i].z(), 1e-14);
    ASSERT_NEAR(v.x(), 0, 1e-15);
  }
}

TEST(ImuErrors, BeyondTheRangeItSaturatesAndMaySaySo) {
  const std::string keys = "gyro_range_degps = 20\naccel_range_g = 1.1\n";
  const Imu silent = imu(keys), honest = imu(keys + "saturated_is_invalid = true\n");
  int gyro = 0, accel = 0;
  for (std::size_t i = 0; i < ideal().theta.size(); ++i) {
    const bool wide = ideal().theta[i].cwiseAbs().maxCoeff() > 20 * deg * dt,
               strong = ideal().v[i].cwiseAbs().maxCoeff() > 1.1 * g0 * dt;
    gyro += wide ? 1 : 0;
    accel += strong ? 1 : 0;
    ASSERT_EQ(silent.samples[i].invalid, 0U);
    ASSERT_EQ(honest.samples[i].invalid, (wide ? 1U : 0U) | (strong ? 2U : 0U));
    ASSERT_LE(silent.theta[i].cwiseAbs().maxCoeff(), 20 * deg * dt * (1 + 1e-12));
    ASSERT_LE(silent.v[i].cwiseAbs().maxCoeff(), 1.1 * g0 * dt * (1 + 1e-12));
    if (!wide) {
      ASSERT_LT((silent.theta[i] - ideal().theta[i]).norm(), 1e-15);
    }
  }
  EXPECT_GT(gyro, 50) << "the flight shows nothing";
  EXPECT_GT(accel, 50) << "the flight shows nothing";
  EXPECT_LT(gyro, 1900);
}

TEST(ImuErrors, StepsAndPulsesOfTheDevice) {
  const Imu coarse = imu("gyro_step_degps = 0.02\naccel_pulse_mps = 0.001\n");
  Vector3 counted = Vector3::Zero(), exact = Vector3::Zero();
  for (std::size_t i = 0; i < ideal().theta.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double steps = coarse.theta[i][axis] / dt / (0.02 * deg);
      ASSERT_NEAR(steps, std::round(ideal().theta[i][axis] / dt / (0.02 * deg)), 1e-6);
    }
    counted += coarse.v[i];
    exact += ideal().v[i];
    ASSERT_LE((counted - exact).cwiseAbs().maxCoeff(), 0.0005 + 1e-12);
  }
}

// A low pass delays a slow motion by 1 / (2 pi f), or sqrt(2) / (2 pi f) for the second order.
TEST(ImuErrors, BandwidthDelays) {
  for (const auto& [order, delay] : {std::pair("1", 1.0), std::pair("2", std::numbers::sqrt2)}) {
    const Imu slow = imu("gyro_bandwidth_hz = 5\ngyro_filter_order = " + std::string(order) + "\n");
    const double late = delay / (2 * std::numbers::pi * 5) - dt / 2;
    double best = HUGE_VAL;
    int best_ms = 0;
    for (int ms = 0; ms < 100; ++ms) {
      double squares = 0;
      for (std::size_t i = 200; i < slow.theta.size(); ++i) {
        const double at = static_cast<double>(i) - 0.1 * ms;
        const auto before = static_cast<std::size_t>(at);
        const double share = at - static_cast<double>(before);
        const Vector3 shifted = (1 - share) * ideal().theta[before] +
                                share * ideal().theta[before + 1 < slow.theta.size() ? before + 1 : before];
        squares += (shifted - slow.theta[i]).squaredNorm();
      }
      if (squares < best) best = squares, best_ms = ms;
    }
    EXPECT_NEAR(1e-3 * best_ms, late, 2e-3) << order;
  }
}

// The Euler acceleration by differences of the rates, the centripetal one by their mean.
TEST(ImuErrors, LeverArmSeesTheRotation) {
  const Vector3 lever(3, -2, 1);
  const Imu off = imu("lever_arm_m = [3, -2, 1]\n");
  for (std::size_t i = 1; i + 1 < off.v.size(); i += 7) {
    const Vector3 before = flight().epochs()[i].omega_ib_b, after = flight().epochs()[i + 1].omega_ib_b;
    const Vector3 mean = (before + after) / 2;
    const Vector3 expected = (after - before).cross(lever) + dt * mean.cross(mean.cross(lever));
    ASSERT_LT((off.v[i] - ideal().v[i] - expected).norm(), 1e-6 + 1e-3 * expected.norm());
  }
  EXPECT_EQ(apart(off.theta, ideal().theta), 0);
}

// The increments of an IMU whose samples are taken early and late add up to those of an exact one.
TEST(ImuErrors, JitterMovesTheSamplesAndNotTheSum) {
  const Imu jittery = imu("sampling_jitter_us = 200\n");
  Vector3 sum = Vector3::Zero(), squares = Vector3::Zero();
  for (std::size_t i = 0; i < jittery.theta.size(); ++i) {
    sum += jittery.theta[i] - ideal().theta[i];
    const Vector3 rate = flight().epochs()[i + 1].omega_ib_b;
    for (int axis = 0; axis < 3; ++axis) squares[axis] += std::pow(sum[axis] / rate[axis], 2);
  }
  // The sum is the rate at the end times the jitter of the last sample.
  EXPECT_NEAR(std::sqrt(squares.z() / 2000), 200e-6, 3 * 200e-6 / std::sqrt(2 * 2000.0));
}

TEST(ImuErrors, ErrorsThatAreAbsentChangeNoNumberOfTheOthers) {
  const std::string noise = "gyro_noise_degprth = 0.1\naccel_noise_ugprthz = 50\ngyro_bias_sigma_degph = 3\n";
  const Imu before = imu(noise),
            after = imu(noise + "gyro_bias_instability_degph = 5\ngyro_range_degps = 500\n");
  EXPECT_EQ(apart(before.v, after.v), 0);
  const double most = 6 * 5 * degph / 0.6174 * dt;
  EXPECT_LT(apart(before.theta, after.theta), most);
  EXPECT_GT(apart(before.theta, after.theta), most / 100);
}

TEST(ImuErrors, WhatIsWrongIsOneLine) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal_of(slave_imu, "gyro_filter_order = 3\n"),
              HasSubstr("gyro_filter_order': is 3, expected 1 or 2"));
  EXPECT_THAT(refusal_of(slave_imu, "gyro_range_degps = 0\n"), HasSubstr("gyro_range_degps"));
  EXPECT_THAT(refusal_of(slave_imu, "temperature_degc = 100\nwarm_up_k = 50\n"),
              HasSubstr("leads to 150 degC"));
  EXPECT_THAT(refusal_of(slave_imu, "gyro_bias_correlation_s = 0\n"), HasSubstr("gyro_bias_correlation_s"));
}

}  // namespace
}  // namespace canhil::sensors
