// The heading of a ship against closed-form solutions of Nomoto's model.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/world/units.hpp"
#include "tests/unit/bench/plant/read_plan.hpp"

namespace canhil::plant {
namespace {

using world::units::deg;

constexpr const char* ship =
    "heading_deg = 30\nspeed_mps = 5\nturn_time_constant_s = 4\nturn_gain_per_s = 0.2\n";

double shown(const Plan& plan, const Plant& plant, std::string_view name) {
  const auto output = std::ranges::find(plan.outputs, name, &Variable::name);
  return plant.outputs()[static_cast<std::size_t>(output - plan.outputs.begin())];
}

void run(Plant& plant, std::int64_t from_us, std::int64_t to_us, double rudder) {
  constexpr std::int64_t step_us = 10'000;
  for (std::int64_t t_us = from_us; t_us < to_us; t_us += step_us)
    ASSERT_TRUE(plant.step(t_us, t_us + step_us, std::array{rudder}));
}

// r = K d (1 - exp(-t / T)), and the heading is its integral.
TEST(SteeredHeading, TurnsAsNomotoSays) {
  const auto plan = good_plan("steered_heading", ship);
  const auto plant = made(*plan);
  run(*plant, 0, 10'000'000, 10 * deg);
  const double t = 10, T = 4, turn_rate = 0.2 * 10 * deg;
  // The actuator without a lag reaches 10 degrees within 10 ms, by its largest rate of 1000 deg/s.
  EXPECT_NEAR(shown(*plan, *plant, "turn_rate"), turn_rate * (1 - std::exp(-t / T)), 2e-4 * turn_rate);
  const double heading = 30 * deg + turn_rate * (t - T * (1 - std::exp(-t / T)));
  EXPECT_NEAR(shown(*plan, *plant, "attitude.heading"), heading, 6e-3 * turn_rate);
  EXPECT_DOUBLE_EQ(shown(*plan, *plant, "velocity.north"),
                   5 * std::cos(shown(*plan, *plant, "attitude.heading")));
  EXPECT_DOUBLE_EQ(shown(*plan, *plant, "velocity.east"),
                   5 * std::sin(shown(*plan, *plant, "attitude.heading")));
}

TEST(SteeredHeading, ItsActuatorHasALagARateAStopAndAnOffset) {
  const auto lags = good_plan("steered_heading", std::string(ship) + "actuator_lag_s = 0.5\n");
  const auto lagging = made(*lags);
  run(*lagging, 0, 1'000'000, 10 * deg);
  EXPECT_NEAR(shown(*lags, *lagging, "rudder"), 10 * deg * (1 - std::exp(-2.0)), 1e-9);
  const auto slow = good_plan("steered_heading", std::string(ship) + "actuator_rate_degps = 4\n");
  const auto slowly = made(*slow);
  run(*slowly, 0, 2'000'000, 30 * deg);
  EXPECT_NEAR(shown(*slow, *slowly, "rudder"), 8 * deg, 1e-12);
  const auto stops = good_plan("steered_heading", std::string(ship) + "actuator_stop_deg = 20\n");
  const auto stopped = made(*stops);
  run(*stopped, 0, 2'000'000, 30 * deg);
  EXPECT_NEAR(shown(*stops, *stopped, "rudder"), 20 * deg, 1e-12);
  const auto offset = good_plan("steered_heading", std::string(ship) + "actuator_offset_deg = -3\n");
  const auto off = made(*offset);
  run(*off, 0, 2'000'000, 5 * deg);
  EXPECT_NEAR(shown(*offset, *off, "rudder"), 2 * deg, 1e-12);
}

// A gust of the acceleration a (1 - cos)/2 over the time D changes a turn rate without damping by a D / 2.
TEST(SteeredHeading, AGustTurnsIt) {
  const auto plan = good_plan("steered_heading",
                              "heading_deg = 0\nspeed_mps = 0\nturn_time_constant_s = 1e9\n"
                              "turn_gain_per_s = 1\ngust_s = [1, 3]\ngust_degps2 = 10\n");
  const auto plant = made(*plan);
  run(*plant, 0, 1'000'000, 0);
  EXPECT_EQ(shown(*plan, *plant, "turn_rate"), 0);
  run(*plant, 1'000'000, 4'000'000, 0);
  EXPECT_NEAR(shown(*plan, *plant, "turn_rate"), 10 * deg, 1e-7 * deg);
}

TEST(SteeredHeading, TheSameInputsGiveTheSameBits) {
  const auto plan = good_plan("steered_heading", ship);
  const auto one = made(*plan), other = made(*plan, {.seed = 7, .run_index = 3});
  run(*one, 0, 3'000'000, 0.1);
  run(*other, 0, 3'000'000, 0.1);
  for (std::size_t i = 0; i < plan->outputs.size(); ++i) EXPECT_EQ(one->outputs()[i], other->outputs()[i]);
}

}  // namespace
}  // namespace canhil::plant
