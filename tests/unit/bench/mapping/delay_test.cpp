// The lag of estimates behind the truth.
#include "bench/checks/delay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bench/quantities/list.hpp"

namespace canhil::checks {
namespace {

constexpr scenario::Window whole{.from_us = 0, .to_us = 20'000'000};

// A sinusoidal roll with an amplitude of 15 deg and a period of 3 s. It is sent every 10 ms with the delay
// `delay`, with noise and an offset.
quantities::Track track(double delay, double noise, double offset, unsigned seed, double amplitude = 0.26) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto roll = [&](double t) { return amplitude * std::sin(2 * std::numbers::pi * t / 3); };
  quantities::Track delayed{.quantity = &quantities::attitude_roll};
  for (int k = 0; k <= 2000; ++k) {
    const double t = 0.01 * k, estimate = roll(t - delay) + offset + noise * normal(random);
    delayed.points.push_back(
        {.t_us = 10'000L * k, .value = estimate - roll(t), .estimate = estimate, .truth = roll(t)});
  }
  return delayed;
}

TEST(Delay, IsFoundWithoutNoise) {
  for (const double delay : {-0.1, 0.0, 0.0037, 0.04, 0.75}) {
    const auto found = delay_of(track(delay, 0, 0.02, 1), whole);
    ASSERT_TRUE(found) << delay;
    EXPECT_NEAR(found->delay_s, delay, 1e-5);
    EXPECT_LT(found->half_width_s, 1e-3);
  }
}

TEST(Delay, LiesInItsIntervalAsOftenAsItSays) {
  int inside = 0;
  constexpr int runs = 400;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const auto found = delay_of(track(0.023, 0.01, -0.1, seed), whole);
    ASSERT_TRUE(found);
    EXPECT_LT(found->half_width_s, 0.005);
    inside += std::abs(found->delay_s - 0.023) <= found->half_width_s ? 1 : 0;
  }
  // 95 % of 400 trials, plus and minus four standard deviations of the binomial distribution.
  EXPECT_GE(inside, 363);
  EXPECT_LE(inside, 397);
}

TEST(Delay, IsNotKnownWhereTheTruthRests) {
  EXPECT_FALSE(delay_of(track(0.02, 0.001, 0, 1, 0.0), whole));
  EXPECT_FALSE(delay_of(track(0.02, 0.5, 0, 1, 0.001), whole));
  EXPECT_FALSE(delay_of(track(0.02, 0.001, 0, 1), {.from_us = 5'000'000, .to_us = 5'100'000}))
      << "11 answers";
}

TEST(Delay, ThatIsNoNumberIsLeftOut) {
  quantities::Track delayed = track(0.02, 0.001, 0, 1);
  for (std::size_t k = 0; k < delayed.points.size(); k += 7) delayed.points[k].estimate = std::nan("");
  const auto found = delay_of(delayed, whole);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->delay_s, 0.02, 0.001);
}

}  // namespace
}  // namespace canhil::checks
