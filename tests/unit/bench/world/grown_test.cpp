// A motion that grows: it passes its points, is smooth between them, and its increments integrate to it.
#include "bench/world/motion/grown.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/world/flight_record.hpp"

namespace canhil::world {
namespace {

constexpr std::int64_t step_us = 10'000;

Euler angles_at(double t) {
  return {.roll = 0.3 * std::sin(2 * t), .pitch = 0.2 * std::sin(3 * t), .heading = 3 + t};
}
Vector3 velocity_at(double t) { return {10 + std::sin(t), 2 * t, 0.3 * std::sin(4 * t)}; }
GrownPath::Point point_at(std::int64_t t_us) {
  const double t = 1e-6 * static_cast<double>(t_us);
  return {.t_us = t_us, .v_eb_n = velocity_at(t), .C_bn = C_bn_from(angles_at(t))};
}
GrownPath grown_to(std::int64_t end_us) {
  GrownPath path(point_at(0));
  for (std::int64_t t_us = step_us; t_us <= end_us; t_us += step_us) path.add(point_at(t_us));
  return path;
}

TEST(GrownPath, PassesItsPointsAndFollowsTheMotionBetweenThem) {
  const GrownPath path = grown_to(2'000'000);
  for (std::int64_t t_us = 100'000; t_us <= 2'000'000; t_us += 1000) {
    const double t = 1e-6 * static_cast<double>(t_us);
    const Movement now = path.movement(t);
    const bool at_point = t_us % step_us == 0;
    // Values: fourth order in the step; the slopes at the points are of second order.
    EXPECT_LT((now.v_eb_n - velocity_at(t)).norm(), at_point ? 1e-12 : 2e-6) << t_us;
    EXPECT_LT((now.C_bn - C_bn_from(angles_at(t))).norm(), at_point ? 1e-12 : 2e-6) << t_us;
    const Vector3 acceleration(std::cos(t), 2, 1.2 * std::cos(4 * t));
    EXPECT_LT((now.v_eb_n_rate - acceleration).norm(), 2e-3) << t_us;
    const Euler rates{.roll = 0.6 * std::cos(2 * t), .pitch = 0.6 * std::cos(3 * t), .heading = 1};
    EXPECT_LT((now.omega_nb_b - omega_nb_b(angles_at(t), rates)).norm(), 2e-3) << t_us;
    EXPECT_EQ(path.velocity(t), now.v_eb_n);
  }
}

// A later point does not change what was known before it.
TEST(GrownPath, IsTheSameWhenItHasGrown) {
  const GrownPath shorter = grown_to(500'000), longer = grown_to(700'000);
  for (const double t : {0.0, 0.004, 0.2, 0.333333, 0.4999})
    EXPECT_EQ(shorter.movement(t).C_bn, longer.movement(t).C_bn) << t;
}

TEST(GrownPath, AccelerationAndRateAreContinuous) {
  const GrownPath path = grown_to(500'000);
  for (const std::int64_t t_us : {100'000, 250'000, 490'000}) {
    const double t = 1e-6 * static_cast<double>(t_us);
    const Movement before = path.movement(t - 1e-5), after = path.movement(t + 1e-5);
    EXPECT_LT((before.v_eb_n_rate - after.v_eb_n_rate).norm(), 3e-3);
    EXPECT_LT((before.omega_nb_b - after.omega_nb_b).norm(), 3e-3);
  }
}

// The record that follows the motion step by step is the one that follows it at once, and its velocity
// increments integrate to the velocity of the points.
TEST(GrownFlight, FollowsStepByStep) {
  const auto path = std::make_shared<GrownPath>(point_at(0));
  const Position start{.latitude = 0.7, .longitude = 0.1, .height = 50};
  FlightRecord record({.start = start, .motion = Grown{path}}, 1'000'000, step_us);
  EXPECT_EQ(record.end_us(), 1'000'000);
  EXPECT_EQ(record.known_until_us(), 0);
  for (std::int64_t t_us = step_us; t_us <= 1'010'000; t_us += step_us) {
    path->add(point_at(t_us));
    record.follow();
  }
  FlightRecord at_once({.start = start, .motion = Grown{path}}, 1'000'000, step_us);
  at_once.follow();
  ASSERT_EQ(record.epochs().size(), 101U);
  Matrix3 C = record.epochs()[0].C_bn;
  for (std::size_t i = 0; i < record.increments().size(); ++i) {
    EXPECT_EQ(record.increments()[i].delta_v, at_once.increments()[i].delta_v);
    EXPECT_EQ(record.increments()[i].delta_theta, at_once.increments()[i].delta_theta);
    C = C * rotation(record.increments()[i].delta_theta);
  }
  EXPECT_LT((C - record.epochs().back().C_bn).norm(), 2e-4) << "coning and the Earth's rate are left";
  EXPECT_EQ(record.at(505'000).position.latitude, at_once.at(505'000).position.latitude);
  const double north_m = (record.epochs().back().position.latitude - start.latitude) * 6.36e6;
  EXPECT_NEAR(north_m, 10 + 1 - std::cos(1.0), 0.02);
}

}  // namespace
}  // namespace canhil::world
