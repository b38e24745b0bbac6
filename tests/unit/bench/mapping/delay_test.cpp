// The lag of estimates behind the truth.
#include "bench/checks/delay.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "bench/quantities/list.hpp"

namespace canhil::checks {
namespace {

using testing::HasSubstr;

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
    ASSERT_TRUE(found) << delay << ": " << found.error().message;
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

// Why the delay of a track is not known.
std::string why_not(const quantities::Track& of, const scenario::Window& window = whole) {
  const auto found = delay_of(of, window);
  return found ? fmt::format("{} s", found->delay_s) : found.error().message;
}

// A track of these functions of time, answered every 10 ms for 20 s.
quantities::Track track_of(const std::function<double(double)>& estimate,
                           const std::function<double(double)>& truth) {
  quantities::Track of{.quantity = &quantities::attitude_roll};
  for (int k = 0; k <= 2000; ++k) {
    const double t = 0.01 * k, x = truth(t), e = x + std::remainder(estimate(t) - x, 2 * std::numbers::pi);
    of.points.push_back({.t_us = 10'000L * k, .value = e - x, .estimate = e, .truth = x});
  }
  return of;
}

double weave(double t) { return 0.26 * std::sin(2 * std::numbers::pi * t / 3); }

TEST(Delay, ThatIsNotKnownHasItsOwnReason) {
  EXPECT_THAT(why_not(track(0.02, 0.001, 0, 1), {.from_us = 5'000'000, .to_us = 5'100'000}),
              HasSubstr("too few answers: 11 of 11"));
  EXPECT_THAT(why_not(track(0.02, 0.001, 0, 1), {.from_us = 0, .to_us = 1'100'000}),
              HasSubstr("too few answers: 11 of 111"));
  EXPECT_EQ(why_not(track(0.02, 0.001, 0, 1, 0.0)), "the truth is constant");
  std::mt19937 random(1);
  std::normal_distribution<double> rounding(1, 1e-16);
  EXPECT_EQ(why_not(track_of([](double) { return 1; }, [&](double) { return rounding(random); })),
            "the truth is constant");
  EXPECT_EQ(why_not(track_of([](double t) { return 0.1 * (t - 0.4); }, [](double t) { return 0.1 * t; })),
            "the truth changes at a constant rate, so a delay looks like an offset");
  EXPECT_THAT(why_not(track(0.02, 0.5, 0, 1, 0.01)), HasSubstr("too uncertain"));
  EXPECT_THAT(why_not(track_of([](double) { return 0; }, weave)),
              HasSubstr("the answers do not follow the truth"));
  EXPECT_THAT(why_not(track_of([](double t) { return 0.26 * std::sin(9 * t); }, weave)),
              HasSubstr("the answers do not follow the truth"));
  EXPECT_THAT(why_not(track(1.2, 0.001, 0, 1)), HasSubstr("at the end of the search, 1000 ms"));
  const auto fast = [](double t) { return 0.26 * std::sin(2 * std::numbers::pi * t / 0.4); };
  EXPECT_THAT(why_not(track_of([&](double t) { return fast(t - 0.02); }, fast)),
              HasSubstr("fit equally well"));
}

// A target that says 0 does not follow a truth that turns several times.
TEST(Delay, OfAConstantAnswerIsNotKnownInATurn) {
  EXPECT_THAT(why_not(track_of([](double) { return 0; }, [](double t) { return 1.3 * t + std::sin(t); })),
              HasSubstr("the answers do not follow the truth"));
}

TEST(Delay, IsFoundInATurnOfAnySpeed) {
  for (const double rate : {0.1, 1.0, 6.0}) {
    const auto truth = [&](double t) { return rate * (t + std::sin(t)); };
    for (const double delay : {0.05, 0.4, 0.9}) {
      const auto found = delay_of(track_of([&](double t) { return truth(t - delay); }, truth), whole);
      ASSERT_TRUE(found) << rate << ": " << found.error().message;
      EXPECT_NEAR(found->delay_s, delay, 1e-3) << rate;
    }
  }
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
