#include "tests/unit/bench/nodes/rounded.hpp"

#include <gtest/gtest.h>

#include <random>

namespace canhil::nodes {
namespace {

using world::Vector3;

constexpr SignalInfo integer{.scale = 0.01, .minimum = -1, .maximum = 1};
constexpr SignalInfo real{.minimum = -1, .maximum = 1, .is_float = true};
constexpr Rounding as_on_the_bus = Rounding::as_on_the_bus;

TEST(IncrementRounding, WhatASampleLosesTheNextOneCarries) {
  IncrementRounding rounding(integer);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> draw(-0.1, 0.1);
  Vector3 measured = Vector3::Zero(), sent = Vector3::Zero();
  for (int i = 0; i < 10'000; ++i) {
    const Vector3 increment(draw(random), draw(random), draw(random));
    measured += increment;
    sent += rounding.round(increment, as_on_the_bus);
    // Half a step, plus the rounding of 1e4 additions of numbers below 100.
    ASSERT_LE((measured - sent).cwiseAbs().maxCoeff(), 0.005 + 1e-9) << i;
  }
}

TEST(IncrementRounding, AFloatPassesBitForBit) {
  IncrementRounding rounding(real);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> draw(-0.1, 0.1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 increment(draw(random), draw(random), draw(random));
    ASSERT_EQ(rounding.round(increment, as_on_the_bus), increment) << i;
  }
}

TEST(IncrementRounding, WithoutRoundingAnIntegerPassesBitForBitToo) {
  IncrementRounding rounding(integer);
  EXPECT_EQ(rounding.round({0.123456789, -0.4, 0.1}, Rounding::none), Vector3(0.123456789, -0.4, 0.1));
  EXPECT_EQ(rounding.round({2.5, 0, 0}, Rounding::none).x(), 1);
  EXPECT_EQ(rounding.round({0, 0, 0}, Rounding::none).x(), 1) << "what the range cuts off follows";
}

TEST(IncrementRounding, WhatTheRangeCutsOffFollowsLater) {
  for (const SignalInfo& signal : {integer, real}) {
    IncrementRounding rounding(signal);
    EXPECT_EQ(rounding.round({2.5, 0, 0}, as_on_the_bus).x(), 1);
    EXPECT_EQ(rounding.round({0, 0, 0}, as_on_the_bus).x(), 1);
    EXPECT_DOUBLE_EQ(rounding.round({0, 0, 0}, as_on_the_bus).x(), 0.5);
  }
}

}  // namespace
}  // namespace canhil::nodes
