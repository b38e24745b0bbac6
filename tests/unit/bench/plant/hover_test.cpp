// The rotorcraft against solutions in closed form.
#include <gmock/gmock.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <numbers>

#include "bench/world/attitude.hpp"
#include "tests/unit/bench/plant/read_plan.hpp"

namespace canhil::plant {
namespace {

using testing::HasSubstr;
using world::Vector3;

constexpr double g = 9.80665, pi = std::numbers::pi;
// Indices of the outputs.
constexpr std::size_t roll = 0, pitch = 1, heading = 2, north_v = 3, east_v = 4, down_v = 5, north = 6,
                      east = 7, down = 8, roll_rate = 9, thrust = 12;
using Inputs = std::vector<double>;
const Inputs at_rest{g, 0, 0, 0};

class Hover : public testing::Test {
 protected:
  void begin(const std::string& keys) {
    plan_ = good_plan("hover", keys);
    ASSERT_NE(plan_, nullptr);
    plant_ = made(*plan_);
  }
  void fly(double seconds, const Inputs& inputs) {
    fly(seconds, [&] { return inputs; });
  }
  void fly(double seconds, const std::function<Inputs()>& inputs) {
    for (const std::int64_t end = t_us_ + std::llround(1e6 * seconds); t_us_ < end; t_us_ += step_us)
      ASSERT_TRUE(plant_->step(t_us_, t_us_ + step_us, inputs()));
  }
  [[nodiscard]] double at(std::size_t output) const { return plant_->outputs()[output]; }
  [[nodiscard]] Vector3 velocity() const { return {at(north_v), at(east_v), at(down_v)}; }
  [[nodiscard]] world::Matrix3 attitude() const {
    return world::C_bn_from({.roll = at(roll), .pitch = at(pitch), .heading = at(heading)});
  }

  static constexpr std::int64_t step_us = 10'000;
  std::unique_ptr<Plan> plan_;
  std::unique_ptr<Plant> plant_;
  std::int64_t t_us_ = 0;
};

TEST_F(Hover, NamesAreThoseThatMoveACarrier) {
  begin("");
  std::vector<std::string> names;
  for (const Variable& one : plan_->outputs) names.push_back(one.name);
  EXPECT_THAT(names, testing::ElementsAre("attitude.roll", "attitude.pitch", "attitude.heading",
                                          "velocity.north", "velocity.east", "velocity.down", "north", "east",
                                          "down", "roll_rate", "pitch_rate", "yaw_rate", "thrust"));
  EXPECT_EQ(plan_->inputs[0].start, g);
}

TEST_F(Hover, StaysWhereItIsWithoutCommands) {
  begin("heading_deg = 90\n");
  fly(10, at_rest);
  EXPECT_NEAR(at(heading), pi / 2, 1e-12);
  EXPECT_EQ(at(thrust), g);
  for (std::size_t i = 0; i < plant_->outputs().size(); ++i) {
    if (i == heading || i == thrust) continue;
    EXPECT_NEAR(at(i), 0, 1e-12) << i;
  }
}

// dv/dt + D v = g (1 - exp(-t / lag)): the thrust ends with its lag, and the drag grows.
TEST_F(Hover, FallsWithDrag) {
  constexpr double lag = 0.2, drag = 0.4, a = 1 / lag, t = 5;
  begin("thrust_lag_s = 0.2\ndrag_per_s = 0.4\n");
  fly(t, {-1, 0, 0, 0});  // less than none is none
  EXPECT_NEAR(at(thrust), g * std::exp(-t / lag), 1e-9);
  EXPECT_NEAR(
      at(down_v),
      g / drag * (1 - std::exp(-drag * t)) - g * (std::exp(-drag * t) - std::exp(-a * t)) / (a - drag), 1e-9);
  EXPECT_NEAR(at(north_v), 0, 1e-12);
}

TEST_F(Hover, KeepsItsEnergyInFreeFallWithoutDrag) {
  begin("drag_per_s = 0\nthrust_lag_s = 0.005\n");
  fly(1, {g, 0, -0.3, 0});
  fly(0.5, {0, 0, 0, 0});  // now the thrust is g exp(-100)
  const auto energy = [&] { return velocity().squaredNorm() / 2 - g * at(down); };
  const double before = energy(), speed = velocity().norm();
  fly(4, {0, 0.2, 0.1, -0.4});
  EXPECT_NEAR(energy(), before, 1e-9);
  EXPECT_GT(velocity().norm(), speed + 20);
}

// w = c (1 - exp(-t / lag)) and its integral.
TEST_F(Hover, RatesFollowTheirCommandsWithTheirLag) {
  constexpr double lag = 0.08, command = 0.1, t = 0.3;
  begin("rate_lag_s = 0.08\n");
  fly(t, {g, command, 0, 0});
  EXPECT_NEAR(at(roll_rate), command * (1 - std::exp(-t / lag)), 1e-9);
  EXPECT_NEAR(at(roll), command * (t - lag * (1 - std::exp(-t / lag))), 1e-9);
}

TEST_F(Hover, LimitsHold) {
  begin(
      "rate_limit_degps = 90\nangular_acceleration_limit_degps2 = 100\nthrust_limit_mps2 = 12\nrate_lag_s = "
      "0.05\n");
  fly(0.5, {100, -50, 0, 0});
  EXPECT_NEAR(at(roll_rate), -50 * pi / 180, 1e-9) << "the largest angular acceleration from the start on";
  fly(3, {100, -50, 0, 0});
  EXPECT_NEAR(at(roll_rate), -90 * pi / 180, 1e-9) << "the largest rate";
  EXPECT_NEAR(at(thrust), 12, 1e-9);
}

// With constant body rates w, C(t) = C(0) exp([w t x]), through every attitude.
TEST_F(Hover, TurnsAtConstantRates) {
  const Vector3 rates(0.9, -1.3, 0.7);
  begin("heading_deg = 30\n");
  const Inputs commands{g, rates.x(), rates.y(), rates.z()};
  fly(2, commands);  // until the lags are over
  const world::Matrix3 before = attitude();
  double steepest = 0;
  for (int i = 1; i <= 100; ++i) {
    fly(0.1, commands);
    steepest = std::max(steepest, std::abs(at(pitch)));
    ASSERT_LT((attitude() - before * world::rotation(0.1 * i * rates)).norm(), 1e-9) << i;
  }
  EXPECT_GT(steepest, 1.2);
}

TEST_F(Hover, TurnsItsHeadingAtAConstantRate) {
  begin("");
  fly(2, {g, 0, 0, 1});
  const double before = at(heading);
  fly(3, {g, 0, 0, 1});
  EXPECT_NEAR(world::wrapped(at(heading) - before - 3), 0, 1e-9);
  EXPECT_NEAR(at(roll), 0, 1e-12);
}

TEST_F(Hover, AcceleratesTowardsItsLowerSide) {
  begin("drag_per_s = 0\nheading_deg = 0\n");
  fly(0.4, {g, 0, -0.5, 0});  // nose down: forwards
  EXPECT_GT(at(north_v), 0.1);
  EXPECT_NEAR(at(east_v), 0, 1e-12);
  begin("drag_per_s = 0\nheading_deg = 0\n");
  t_us_ = 0;
  fly(0.4, {g, 0.5, 0, 0});  // right side down: to the right
  EXPECT_GT(at(east_v), 0.1);
  EXPECT_NEAR(at(north_v), 0, 1e-12);
}

// dv/dt = D (W (1 - cos(O s)) / 2 - v), s: time in the gust; afterwards the velocity decays.
TEST_F(Hover, DriftsInAGust) {
  constexpr double drag = 0.5, most = 4, length = 2, omega = 2 * pi / length;
  begin("drag_per_s = 0.5\ngust_s = [1, 3]\ngust_north_mps = 4\ngust_east_mps = -2\n");
  const auto drift = [&](double s) {
    const double decay = std::exp(-drag * s), square = drag * drag;
    return most / 2 *
           (1 - decay -
            (square * std::cos(omega * s) + drag * omega * std::sin(omega * s) - square * decay) /
                (square + omega * omega));
  };
  fly(1, at_rest);
  EXPECT_EQ(at(north_v), 0);
  fly(1.3, at_rest);
  EXPECT_NEAR(at(north_v), drift(1.3), 1e-9);
  EXPECT_NEAR(at(east_v), -drift(1.3) / 2, 1e-9);
  fly(2.7, at_rest);
  EXPECT_NEAR(at(north_v), drift(length) * std::exp(-drag * 2), 1e-9);
}

TEST_F(Hover, DriftsWithASteadyWind) {
  begin("drag_per_s = 2\nwind_north_mps = 3\nwind_east_mps = -1\n");
  fly(20, at_rest);
  EXPECT_NEAR(at(north_v), 3, 1e-9);
  EXPECT_NEAR(at(east), -20 + 1 / 2.0, 1e-9);
}

TEST_F(Hover, IsTheSameEachTimeAndForEveryStep) {
  const Inputs commands{11, 0.3, -0.2, 0.5};
  const std::string keys = "gust_s = [0.1, 0.7]\ngust_down_mps = 2\nwind_east_mps = 1\n";
  const auto plan = good_plan("hover", keys);
  const auto one = made(*plan), other = made(*plan), finer = made(*plan);
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(one->step(10'000 * i, 10'000 * (i + 1), commands));
    ASSERT_TRUE(other->step(10'000 * i, 10'000 * (i + 1), commands));
    for (int k = 0; k < 5; ++k)
      ASSERT_TRUE(finer->step(10'000 * i + 2000 * k, 10'000 * i + 2000 * (k + 1), commands));
  }
  EXPECT_EQ(values(*one), values(*other));
  for (std::size_t i = 0; i < one->outputs().size(); ++i)
    EXPECT_NEAR(one->outputs()[i], finer->outputs()[i], 1e-11) << i;
}

// A simple autopilot of the kind that the plant is made for: position to tilt, tilt to rates.
TEST_F(Hover, AnAutopilotHoldsItsPlaceInAGust) {
  begin("heading_deg = 50\ngust_s = [2, 4]\ngust_north_mps = 6\ngust_east_mps = 3\n");
  double farthest = 0;
  fly(20, [&] {
    const double c = std::cos(at(heading)), s = std::sin(at(heading));
    const double a_north = -2 * at(north) - 2.5 * at(north_v), a_east = -2 * at(east) - 2.5 * at(east_v);
    const double wanted_pitch = -(c * a_north + s * a_east) / g, wanted_roll = (c * a_east - s * a_north) / g;
    farthest = std::max(farthest, std::hypot(at(north), at(east)));
    return Inputs{(g + 4 * at(down) + 3 * at(down_v)) / (std::cos(at(roll)) * std::cos(at(pitch))),
                  6 * (wanted_roll - at(roll)), 6 * (wanted_pitch - at(pitch)), -1 * at(heading)};
  });
  EXPECT_GT(farthest, 0.3);
  EXPECT_LT(farthest, 2);
  EXPECT_NEAR(at(north), 0, 0.01);
  EXPECT_NEAR(at(east), 0, 0.01);
  EXPECT_NEAR(at(down), 0, 0.01);
  EXPECT_NEAR(at(heading), 0, 0.01);
}

TEST(HoverKeys, AreChecked) {
  EXPECT_THAT(read_plan("hover", "thrust_lag_s = 0.001\n").error, HasSubstr("key 'plant.thrust_lag_s'"));
  EXPECT_THAT(read_plan("hover", "gust_north_mps = 3\n").error,
              HasSubstr("key 'plant.gust_north_mps': has no time, expected gust_s beside it"));
  EXPECT_THAT(read_plan("hover", "mass_kg = 3\n").error, HasSubstr("key 'plant.mass_kg': is unknown"));
  EXPECT_THAT(read_plan("hover", "thrust_limit_mps2 = 0\n").error,
              HasSubstr("key 'plant.thrust_limit_mps2'"));
}

}  // namespace
}  // namespace canhil::plant
