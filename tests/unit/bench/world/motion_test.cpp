#include "bench/world/motion.hpp"

#include <gtest/gtest.h>

#include "bench/world/flight_record.hpp"
#include "bench/world/units.hpp"
#include "tests/unit/target/estimators/csv.hpp"

namespace canhil::world {
namespace {

using units::deg;

const Weave weave{.heading = 0.7,
                  .speed = 150,
                  .heading_amplitude = 20 * deg,
                  .turn_period = 12,
                  .pitch_amplitude = 4 * deg,
                  .pitch_period = 7,
                  .coning_amplitude = 0.2 * deg,
                  .coning_period = 0.1};

// The path of the reference simulation of Kang, Kim, Park (2006), in which the roll follows the heading rate.
const SPath s_path{.speed = 3,
                   .heading = 40 * deg,
                   .heading_amplitude = 50 * deg,
                   .heading_period = 33,
                   .pitch_amplitude = 2 * deg,
                   .pitch_period = 80,
                   .roll_amplitude = 2 * deg,
                   .roll_period = 33,
                   .depth = {}};
constexpr DepthProfile yo_yo{.depth = 30, .period = 60};

// The error of central differences with step h is h^2/6 times the third derivative.
void expect_rates_are_derivatives(const Motion& motion, double t, double h, double tolerance) {
  const Movement before = movement(motion, t - h);
  const Movement now = movement(motion, t);
  const Movement after = movement(motion, t + h);
  EXPECT_LT(((after.v_eb_n - before.v_eb_n) / (2 * h) - now.v_eb_n_rate).norm(), tolerance);
  EXPECT_LT((now.C_bn.transpose() * (after.C_bn - before.C_bn) / (2 * h) - skew(now.omega_nb_b)).norm(),
            tolerance);
  EXPECT_EQ(velocity(motion, t), now.v_eb_n);
}

TEST(Motion, RatesAreTheDerivativesOfWhatMoves) {
  // Coning: an amplitude of 3.5e-3 rad at 63 rad/s has a third derivative of 870 rad/s^3, so the error at
  // h = 1e-5 is 1.5e-8.
  for (const double t : {0.0, 1.3, 5.0, 11.7}) expect_rates_are_derivatives(weave, t, 1e-5, 1e-6);
  const LevelAcceleration level{.heading = 1.0, .speed = 100, .cruise_us = 10'000'000, .acceleration = 9.8};
  for (const double t : {1.0, 15.0}) expect_rates_are_derivatives(level, t, 1e-5, 1e-6);
  SPath diving = s_path;
  diving.depth = yo_yo;
  const Racetrack track{.speed = 3, .heading = 1, .leg = 50, .turn = 20, .roll = 0.1, .depth = yo_yo};
  const Spiral spiral{.speed = 3, .heading = 1, .period = 40, .roll = 0.1, .depth = yo_yo};
  const RestThenGo going{.speed = 3, .heading = 1, .rest = 30, .start = 10, .depth = yo_yo};
  for (const double t : {0.5, 29.0, 33.0, 55.0, 61.0, 77.0, 128.0}) {
    for (const Motion& motion : {Motion(diving), Motion(track), Motion(spiral), Motion(going)})
      expect_rates_are_derivatives(motion, t, 1e-4, 1e-6);
  }
}

TEST(Motion, TheLevelFlightCruisesThenAccelerates) {
  const LevelAcceleration level{
      .heading = 90 * deg, .speed = 100, .cruise_us = 10'000'000, .acceleration = 5};
  EXPECT_LT((kinematics(level, 9.9).v_eb_n - Vector3(0, 100, 0)).norm(), 1e-12);
  EXPECT_EQ(kinematics(level, 9.9).v_eb_n_rate.norm(), 0.0);
  EXPECT_LT((kinematics(level, 12.0).v_eb_n - Vector3(0, 110, 0)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(kinematics(level, 10.0).v_eb_n_rate.norm(), 5.0) << "right-continuous";
  EXPECT_EQ(kinematics(level, 12.0).angles.heading, 90 * deg);
  EXPECT_EQ(jumps_us(level, 9'999'999, 10'000'001), std::vector<std::int64_t>{10'000'000});
  EXPECT_TRUE(jumps_us(level, 10'000'000, 20'000'000).empty()) << "ends are excluded";
}

TEST(Motion, TheWeaveIsCoordinated) {
  // Without coning and pitch, a coordinated turn has no lateral specific force.
  Weave smooth = weave;
  smooth.coning_amplitude = 0;
  smooth.pitch_amplitude = 0;
  for (double t = 0; t < 24; t += 0.37) {
    const Kinematics now = kinematics(smooth, t);
    const Vector3 f_n = now.v_eb_n_rate - Vector3(0, 0, units::standard_gravity);
    EXPECT_NEAR((C_bn_from(now.angles).transpose() * f_n).y(), 0.0, 1e-12);
    EXPECT_NEAR(now.v_eb_n.norm(), smooth.speed, 1e-11);
  }
  EXPECT_EQ(kinematics(smooth, 0).angles.roll, 0.0) << "starts with wings level";
  EXPECT_GT(std::abs(kinematics(smooth, 3).angles.roll), 60 * deg) << "the turn is real";
}

// Compares one second at a time with another simulation: the heading, and the increments of an IMU with
// errors of 1 deg/h, 0.3 deg/sqrt(h), 1000 ug and 50 ug/sqrt(Hz).
TEST(Motion, TheSPathIsThatOfTheReference) {
  const Csv seconds(TEST_DATA_DIR "/s_path/seconds.csv");
  const FlightRecord flight(
      {.start = {.latitude = 35 * deg, .longitude = 129 * deg, .height = -10}, .motion = s_path}, 90'000'000,
      20'000);
  const Vector3 rotation_bar = Vector3::Constant(5 * (units::degph + 0.3 * units::degprth));
  const Vector3 velocity_bar = Vector3::Constant(5 * (1000 * units::ug + 50 * units::ugprthz));
  ASSERT_EQ(seconds.rows(), 90U);
  for (std::size_t second = 0; second < seconds.rows(); ++second) {
    Vector3 rotation = Vector3::Zero();
    Vector3 velocity = Vector3::Zero();
    for (std::size_t i = 50 * second; i < 50 * (second + 1); ++i) {
      rotation += flight.increments()[i].delta_theta;
      velocity += flight.increments()[i].delta_v;
    }
    const double heading = euler_from(flight.epochs()[50 * (second + 1)].C_bn).heading;
    EXPECT_NEAR(heading, seconds.at(second, "heading_true"), 1e-12);
    const Eigen::Map<const Vector3> dth(seconds.from(second, "dthx"));
    const Eigen::Map<const Vector3> dv(seconds.from(second, "dvx"));
    EXPECT_TRUE(((rotation - dth).cwiseAbs().array() < rotation_bar.array()).all()) << second;
    EXPECT_TRUE(((velocity - dv).cwiseAbs().array() < velocity_bar.array()).all()) << second;
  }
}

TEST(Motion, AnSPathWithoutAmplitudesIsStraight) {
  const SPath straight{.speed = 3, .heading = 90 * deg, .depth = {}};
  for (const double t : {0.0, 12.3, 100.0}) {
    EXPECT_LT((kinematics(straight, t).v_eb_n - Vector3(0, 3, 0)).norm(), 1e-12);
    EXPECT_EQ(kinematics(straight, t).v_eb_n_rate.norm(), 0.0);
  }
}

TEST(Motion, AVehicleFollowsItsDepthProfile) {
  const SPath diving{.speed = 3, .heading = 0.3, .depth = yo_yo};
  const FlightRecord flight({.start = {.latitude = 0.6, .longitude = 2, .height = 0}, .motion = diving},
                            120'000'000, 20'000);
  for (const auto& [t_us, height] : {std::pair{15'000'000, -15.0}, {30'000'000, -30.0}, {60'000'000, 0.0}})
    EXPECT_NEAR(flight.at(t_us).position.height, height, 1e-6) << t_us;
  EXPECT_NEAR(kinematics(diving, 15).v_eb_n.norm(), 3, 1e-12) << "along its nose";
}

TEST(Motion, ARacetrackTurnsHalfAroundAfterEachLeg) {
  const Racetrack track{.speed = 3, .heading = 10 * deg, .leg = 50, .turn = 20, .roll = 5 * deg, .depth = {}};
  EXPECT_EQ(kinematics(track, 49).angles.heading, 10 * deg);
  EXPECT_NEAR(kinematics(track, 60).angles.heading, 100 * deg, 1e-12);
  EXPECT_NEAR(kinematics(track, 60).angles.roll, 5 * deg, 1e-12);
  EXPECT_NEAR(kinematics(track, 71).angles.heading, 190 * deg, 1e-12);
  EXPECT_NEAR(kinematics(track, 139.999).angles.heading, 370 * deg, 1e-9);
  EXPECT_NEAR(kinematics(track, 140.001).angles.heading, 370 * deg, 1e-9);
}

TEST(Motion, ASpiralTurnsAtOneRate) {
  const Spiral spiral{.speed = 2, .heading = 0, .period = 40, .roll = 0.1, .depth = {}};
  EXPECT_NEAR(kinematics(spiral, 10).angles.heading, 90 * deg, 1e-12);
  EXPECT_LT((kinematics(spiral, 10).v_eb_n - Vector3(0, 2, 0)).norm(), 1e-12);
}

TEST(Motion, RestsAndThenGoes) {
  const RestThenGo motion{.speed = 3, .heading = 0, .rest = 30, .start = 10, .depth = {}};
  EXPECT_EQ(kinematics(motion, 29.9).v_eb_n.norm(), 0.0);
  EXPECT_NEAR(kinematics(motion, 35).v_eb_n.x(), 1.5, 1e-12);
  EXPECT_NEAR(kinematics(motion, 35).v_eb_n_rate.x(), 0.6, 1e-12);
  EXPECT_NEAR(kinematics(motion, 40).v_eb_n.x(), 3, 1e-12);
  EXPECT_EQ(kinematics(motion, 60).v_eb_n_rate.norm(), 0.0);
}

}  // namespace
}  // namespace canhil::world
