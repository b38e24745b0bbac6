#include "bench/world/motion.hpp"

#include <gtest/gtest.h>

#include "bench/world/units.hpp"

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

// Central differences with step h err by h^2/6 times the third derivative.
void expect_rates_are_derivatives(const Motion& motion, double t, double h, double tolerance) {
  const Kinematics before = kinematics(motion, t - h);
  const Kinematics now = kinematics(motion, t);
  const Kinematics after = kinematics(motion, t + h);
  EXPECT_LT(((after.v_eb_n - before.v_eb_n) / (2 * h) - now.v_eb_n_rate).norm(), tolerance);
  EXPECT_NEAR((after.angles.roll - before.angles.roll) / (2 * h), now.rates.roll, tolerance);
  EXPECT_NEAR((after.angles.pitch - before.angles.pitch) / (2 * h), now.rates.pitch, tolerance);
  EXPECT_NEAR((after.angles.heading - before.angles.heading) / (2 * h), now.rates.heading, tolerance);
}

TEST(Motion, RatesAreTheDerivativesOfWhatMoves) {
  // Coning: amplitude 3.5e-3 rad at 63 rad/s has a third derivative of 870 rad/s^3: 1.5e-8 of error at h =
  // 1e-5.
  for (const double t : {0.0, 1.3, 5.0, 11.7}) expect_rates_are_derivatives(weave, t, 1e-5, 1e-6);
  const LevelAcceleration level{.heading = 1.0, .speed = 100, .cruise_us = 10'000'000, .acceleration = 9.8};
  for (const double t : {1.0, 15.0}) expect_rates_are_derivatives(level, t, 1e-5, 1e-6);
}

TEST(Motion, TheLevelFlightCruisesThenAccelerates) {
  const LevelAcceleration level{
      .heading = 90 * deg, .speed = 100, .cruise_us = 10'000'000, .acceleration = 5};
  EXPECT_LT((kinematics(level, 9.9).v_eb_n - Vector3(0, 100, 0)).norm(), 1e-12);
  EXPECT_EQ(kinematics(level, 9.9).v_eb_n_rate.norm(), 0.0);
  EXPECT_LT((kinematics(level, 12.0).v_eb_n - Vector3(0, 110, 0)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(kinematics(level, 10.0).v_eb_n_rate.norm(), 5.0) << "right-continuous";
  EXPECT_EQ(kinematics(level, 12.0).angles.heading, 90 * deg);
  EXPECT_EQ(jumps_us(level), std::vector<std::int64_t>{10'000'000});
}

TEST(Motion, TheWeaveIsCoordinated) {
  // Without coning, the lateral specific force that roll leaves is the small part from the climb rate alone.
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

}  // namespace
}  // namespace canhil::world
