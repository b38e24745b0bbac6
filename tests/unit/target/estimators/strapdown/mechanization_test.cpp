#include "target/estimators/strapdown/mechanization.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/strapdown/earth.hpp"

namespace canhil::strapdown {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A motion in closed form near one place; its increments are integrated in fine steps (Simpson).
struct Motion {
  std::function<Matrix3d(double)> C_bn;
  std::function<Vector3d(double)> omega_nb_b;
  std::function<Vector3d(double)> v_eb_n;
  std::function<Vector3d(double)> acceleration_n;
};

constexpr double flight_latitude = 0.65, flight_height = 1000;

ImuIncrement increment(const Motion& motion, double t, double dt) {
  const LocalEarth earth = local_earth(flight_latitude, flight_height);
  constexpr int interval_count = 16;
  ImuIncrement imu{Vector3d::Zero(), Vector3d::Zero(), dt};
  for (int i = 0; i <= interval_count; ++i) {
    const double weight = (i == 0 || i == interval_count ? 1 : i % 2 == 1 ? 4 : 2) * dt / interval_count / 3;
    const double now = t + dt * i / interval_count;
    const Vector3d v = motion.v_eb_n(now);
    const Vector3d omega_en = transport_rate(earth, flight_height, v);
    const Matrix3d C_nb = motion.C_bn(now).transpose();
    const Vector3d coriolis = (2 * earth.omega_ie_n + omega_en).cross(v);
    imu.delta_theta += weight * (motion.omega_nb_b(now) + C_nb * (earth.omega_ie_n + omega_en));
    imu.delta_v += weight * (C_nb * (motion.acceleration_n(now) + coriolis - Vector3d(0, 0, earth.gravity)));
  }
  return imu;
}

struct Errors {
  double attitude, velocity;
};

Errors fly(
    const Motion& motion, Mechanization kind, double duration, double dt,
    const std::function<double(int)>& stretch = [](int) { return 1.0; }) {
  NavState nav;
  nav.latitude = flight_latitude;
  nav.height = flight_height;
  nav.C_bn = motion.C_bn(0);
  nav.v_eb_n = motion.v_eb_n(0);
  ImuIncrement previous;
  double t = 0;
  for (int k = 0; t < duration - dt / 2; ++k) {
    const double step = dt * stretch(k);
    const ImuIncrement imu = increment(motion, t, step);
    nav = mechanize(kind, nav, previous, imu).nav;
    previous = imu;
    t += step;
  }
  return {misalignment(nav.C_bn, motion.C_bn(t)).norm(), (nav.v_eb_n - motion.v_eb_n(t)).norm()};
}

Vector3d still(double) { return Vector3d::Zero(); }

class BothKinds : public testing::TestWithParam<Mechanization> {};
INSTANTIATE_TEST_SUITE_P(Mechanizations, BothKinds,
                         testing::Values(Mechanization::reference, Mechanization::two_sample));

TEST_P(BothKinds, StaysAtRest) {
  Matrix3d C = dcm_from_euler({0.3, -0.2, 2.0});
  const Motion rest{[&](double) { return C; }, still, still, still};
  const Errors errors = fly(rest, GetParam(), 60, 0.01);
  EXPECT_LT(errors.attitude, 1e-12);             // 6000 roundings
  EXPECT_LT(errors.velocity, 1e-12 * 9.8 * 60);  // a tilt of this size under gravity for 60 s
}

// A tilted INS at rest oscillates with Schuler's period: after a quarter of this period, |V_N| is
// g tilt / w_s, where w_s is sqrt(g/R). At the equator the coupling through the earth rate is of order
// (w_ie/w_s)^2, which is 0.3 %.
TEST_P(BothKinds, SwingsWithSchulersPeriod) {
  const LocalEarth earth = local_earth(0, 0);
  const double omega = std::sqrt(earth.gravity / earth.meridian_radius), tilt = 1e-4, dt = 0.5;
  const ImuIncrement truth{earth.omega_ie_n * dt, Vector3d(0, 0, -earth.gravity * dt), dt};
  NavState nav;
  nav.C_bn = exp_rotation({0, tilt, 0});
  ImuIncrement previous;
  const int quarter = static_cast<int>(std::numbers::pi / 2 / omega / dt);
  double velocity_at_quarter = 0;
  for (int k = 0; k < 2 * quarter; ++k) {
    nav = (GetParam() == Mechanization::reference ? mechanize_reference(nav, truth)
                                                  : mechanize_two_sample(nav, previous, truth))
              .nav;
    previous = truth;
    if (k + 1 == quarter) velocity_at_quarter = nav.v_eb_n.x();
  }
  const double amplitude = -earth.gravity * tilt / omega;
  EXPECT_NEAR(velocity_at_quarter / amplitude, 1, 0.01);
  EXPECT_NEAR(nav.v_eb_n.x() / amplitude, 0, 0.02) << "half a period: velocity is back at zero";
  EXPECT_NEAR(nav.latitude / (2 * amplitude / omega / earth.meridian_radius), 1, 0.01);
}

// Tests the quantities of a step that a filter uses. The velocity change must equal the specific force plus
// gravity and Coriolis terms.
TEST_P(BothKinds, StepReportsTheSpecificForceItUsed) {
  NavState nav;
  nav.C_bn = dcm_from_euler({0.1, 0.2, 0.3});
  nav.latitude = flight_latitude;
  nav.v_eb_n << 100, 50, -5;
  const double dt = 0.01;
  const ImuIncrement imu{{0.001, 0.002, -0.003}, {0.02, 0.01, -0.1}, dt};
  const MechanizationStep step = GetParam() == Mechanization::reference ? mechanize_reference(nav, imu)
                                                                        : mechanize_two_sample(nav, imu, imu);
  const LocalEarth earth = local_earth(flight_latitude, 0);
  const Vector3d coriolis = (2 * step.omega_ie_n + step.omega_en_n).cross(nav.v_eb_n);
  const Vector3d force = step.nav.v_eb_n - nav.v_eb_n - (Vector3d(0, 0, earth.gravity) - coriolis) * dt;
  EXPECT_LT((step.delta_v_n - force).norm(), 1e-7);
  EXPECT_LT((step.C_bn_mean * imu.delta_v - step.delta_v_n).norm(), 1e-6);
  EXPECT_LT((step.C_bn_mean - 0.5 * (nav.C_bn + step.nav.C_bn)).norm(), 1e-15);
}

// A coning motion. Its rotation vector is theta (0, cos wt, sin wt), and its body rate has the components
// -w (1 - cos theta), -w sin theta sin wt and w sin theta cos wt. With x = w dt, the drift per sample is
// theta^2 (x - sin x)/2 for the one-sample mechanisation, and theta^2 x^5/60 for the two-sample
// mechanisation.
Motion coning(double theta, double omega) {
  const auto phi = [=](double t) {
    return Vector3d(0, theta * std::cos(omega * t), theta * std::sin(omega * t));
  };
  return {[=](double t) { return exp_rotation(phi(t)); },
          [=](double t) {
            return Vector3d(-omega * (1 - std::cos(theta)), -omega * std::sin(theta) * std::sin(omega * t),
                            omega * std::sin(theta) * std::cos(omega * t));
          },
          still, still};
}

TEST(Mechanization, TwoSamplesFollowConing) {
  const double theta = 0.02, omega = 2 * std::numbers::pi * 5, dt = 0.01, duration = 10;
  const Motion motion = coning(theta, omega);
  const double x = omega * dt;
  const double expected_drift = omega * theta * theta / 2 * (1 - std::sin(x) / x) * duration;
  const Errors one = fly(motion, Mechanization::reference, duration, dt);
  const Errors two = fly(motion, Mechanization::two_sample, duration, dt);
  EXPECT_NEAR(one.attitude / expected_drift, 1, 0.02);
  EXPECT_NEAR(two.attitude / (theta * theta * std::pow(x, 5) / 60 / dt * duration), 1, 0.1);
  EXPECT_LT(two.attitude, one.attitude / 40);
  EXPECT_LT(two.velocity, one.velocity / 20);
}

// A lost sample is bridged with a longer sample. The unequal times must not bring back the coning error.
TEST(Mechanization, TwoSamplesFollowConingAtUnequalSampleTimes) {
  const Motion motion = coning(0.02, 2 * std::numbers::pi * 5);
  const auto uneven = [](int k) { return k % 3 == 0 ? 2.0 : 1.0; };
  const Errors one = fly(motion, Mechanization::reference, 10, 0.005, uneven);
  const Errors two = fly(motion, Mechanization::two_sample, 10, 0.005, uneven);
  EXPECT_LT(two.attitude, one.attitude / 30);
}

// Sculling: the roll is theta sin wt, the eastward acceleration is A sin wt, and x is w dt. The rectified
// acceleration is theta A/2. The error of the one-sample step is x^2/6 of this acceleration, the error of the
// two-sample step is x^4/30 of this acceleration.
TEST(Mechanization, TwoSamplesFollowSculling) {
  const double theta = 0.02, A = 10, omega = 2 * std::numbers::pi * 5;
  const Motion motion{[=](double t) {
                        return exp_rotation({theta * std::sin(omega * t), 0, 0});
                      },
                      [=](double t) { return Vector3d(theta * omega * std::cos(omega * t), 0, 0); },
                      [=](double t) { return Vector3d(0, -A / omega * std::cos(omega * t), 0); },
                      [=](double t) { return Vector3d(0, A * std::sin(omega * t), 0); }};
  const double dt = 0.01, duration = 10, x = omega * dt;
  const Errors one = fly(motion, Mechanization::reference, duration, dt);
  const Errors two = fly(motion, Mechanization::two_sample, duration, dt);
  EXPECT_NEAR(one.velocity / (theta * A / 2 * x * x / 6 * duration), 1, 0.1);
  EXPECT_NEAR(two.velocity / (theta * A / 2 * std::pow(x, 4) / 30 * duration), 1, 0.1);
}

// The specific force must be rotated by half of the rotation during the step, which leaves an error of second
// order in this rotation. Without this half rotation, the velocity would be off by 0.5 |omega| dt |f| t.
TEST(Mechanization, OneSampleFollowsATurnAtConstantRate) {
  const double rate = 0.3;
  const Motion turn{
      [&](double t) {
        return dcm_from_euler({0.05, -0.1, rate * t});
      },
      [&](double) {
        return Vector3d(dcm_from_euler({0.05, -0.1, 0}).transpose() * Vector3d(0, 0, rate));
      },
      [&](double t) { return Vector3d(3 * std::cos(rate * t), 3 * std::sin(rate * t), 0); },
      [&](double t) { return Vector3d(-3 * rate * std::sin(rate * t), 3 * rate * std::cos(rate * t), 0); }};
  const Errors errors = fly(turn, Mechanization::one_sample, 20, 0.02);
  // The step uses 2 g/a as the free-air gradient. This differs from the gradient of the test by 1e-8 1/s^2,
  // which acts at 1000 m for 20 s.
  EXPECT_LT(errors.velocity, 5e-4);
  // The step uses the earth rate in the body axes at the start of the step. The error is the earth's rotation
  // in 20 s, 1.5e-3 rad, times half of the rotation in a step, 3e-3 rad.
  EXPECT_LT(errors.attitude, 5e-6);
  EXPECT_LT(fly(turn, Mechanization::two_sample, 20, 0.02).velocity, errors.velocity);
}

}  // namespace
}  // namespace canhil::strapdown
