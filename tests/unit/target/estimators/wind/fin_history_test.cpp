#include "target/estimators/wind/fin_history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace canhil::wind {
namespace {

constexpr double limit = 0.35;

FinHistory elevator_at(std::initializer_list<std::pair<std::int64_t, double>> samples) {
  FinHistory fins;
  for (const auto& [t_us, elevator] : samples)
    EXPECT_EQ(fins.push(t_us, {elevator, -elevator, elevator / 2}, limit), FinOutcome::kept);
  return fins;
}

TEST(FinHistory, MeanOfTheSamplesJoinedByLines) {
  const FinHistory fins = elevator_at({{0, 0.0}, {10'000, 0.1}, {20'000, 0.05}});
  const ActingFins acting = fins.over(0, 20'000);
  EXPECT_NEAR(acting.mean.elevator, (0.05 + 0.075) / 2, 1e-15);
  EXPECT_NEAR(acting.mean.aileron, -0.0625, 1e-15);
  EXPECT_NEAR(acting.mean.rudder, 0.03125, 1e-15);
  EXPECT_EQ(acting.gap_us, 10'000);
  EXPECT_NEAR(fins.over(5'000, 15'000).mean.elevator, (0.075 + 0.0875) / 2, 1e-15);
  EXPECT_NEAR(fins.over(12'000, 14'000).mean.elevator, 0.085, 1e-15);
}

TEST(FinHistory, NewestIsHeldAndItsAgeSaid) {
  const FinHistory fins = elevator_at({{0, 0.0}, {10'000, 0.1}});
  const ActingFins after = fins.over(10'000, 30'000);
  EXPECT_NEAR(after.mean.elevator, 0.1, 1e-15);
  EXPECT_EQ(after.gap_us, 20'000);
  EXPECT_NEAR(fins.over(0, 20'000).mean.elevator, 0.075, 1e-15);
  EXPECT_EQ(fins.over(400'000, 420'000).gap_us, 410'000);
}

TEST(FinHistory, AMissedSampleShowsAsAGap) {
  const FinHistory fins = elevator_at({{0, 0.0}, {20'000, 0.1}, {60'000, 0.3}, {80'000, 0.3}});
  EXPECT_NEAR(fins.over(40'000, 60'000).mean.elevator, 0.25, 1e-15);
  EXPECT_EQ(fins.over(40'000, 60'000).gap_us, 40'000);
  EXPECT_EQ(fins.over(60'000, 80'000).gap_us, 20'000);
}

TEST(FinHistory, OldestIsHeldBeforeIt) {
  const FinHistory fins = elevator_at({{100'000, 0.2}, {120'000, 0.3}});
  const ActingFins acting = fins.over(80'000, 100'000);
  EXPECT_NEAR(acting.mean.elevator, 0.2, 1e-15);
  EXPECT_EQ(acting.gap_us, 20'000);
}

TEST(FinHistory, SaysWhenItKnowsNothing) {
  const ActingFins acting = FinHistory().over(0, 20'000);
  EXPECT_FALSE(acting.known);
  EXPECT_EQ(acting.mean, Deflection());
}

TEST(FinHistory, KeepsTheLastOfMany) {
  FinHistory fins;
  for (int k = 0; k < 1000; ++k) fins.push(k * 10'000L, {k * 1e-4, 0, 0}, limit);
  EXPECT_NEAR(fins.over(9'400'000, 9'420'000).mean.elevator, 0.0941, 1e-12);
  EXPECT_NEAR(fins.over(0, 20'000).mean.elevator, 0.0936, 1e-12);  // the oldest of the 64 samples
  EXPECT_GT(fins.over(0, 20'000).gap_us, 9'000'000);
}

TEST(FinHistory, RefusesWhatIsNotPhysicalOrInOrder) {
  FinHistory fins = elevator_at({{0, 0.1}, {20'000, 0.1}});
  EXPECT_FALSE(fins.over(0, 20'000).not_physical);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Deflection& bad : {Deflection{nan, 0, 0}, Deflection{0, 1, 0}, Deflection{0, 0, -1e300}}) {
    EXPECT_EQ(fins.push(40'000, bad, limit), FinOutcome::not_physical);
    EXPECT_TRUE(fins.over(20'000, 40'000).not_physical);
    EXPECT_NEAR(fins.over(20'000, 40'000).mean.elevator, 0.1, 1e-15);
  }
  EXPECT_EQ(fins.push(20'000, {0.2, 0, 0}, limit), FinOutcome::out_of_order);
  EXPECT_EQ(fins.push(10'000, {0.2, 0, 0}, limit), FinOutcome::out_of_order);
  EXPECT_NEAR(fins.over(0, 20'000).mean.elevator, 0.1, 1e-15);
}

TEST(FinHistory, ATimeInTheFutureIsOutvotedByTheNextTwo) {
  FinHistory fins = elevator_at({{0, 0.1}, {20'000, 0.1}, {5'000'000, 0.3}});
  EXPECT_EQ(fins.push(40'000, {0.1, 0, 0}, limit), FinOutcome::out_of_order);
  EXPECT_EQ(fins.push(40'000, {0.1, 0, 0}, limit), FinOutcome::out_of_order) << "the same one again";
  EXPECT_EQ(fins.push(60'000, {0.2, 0, 0}, limit), FinOutcome::kept);
  EXPECT_NEAR(fins.over(40'000, 60'000).mean.elevator, 0.15, 1e-15);
  EXPECT_EQ(fins.push(80'000, {0.2, 0, 0}, limit), FinOutcome::kept);
}

TEST(FinHistory, ThoseThatOvertakeOneAnotherKeepTheirOrder) {
  FinHistory fins;
  int late = 0;
  for (const std::int64_t t_us : {20'000, 0, 60'000, 40'000, 100'000, 80'000})
    late += fins.push(t_us, {0.1, 0, 0}, limit) == FinOutcome::out_of_order ? 1 : 0;
  EXPECT_EQ(late, 3);
}

}  // namespace
}  // namespace canhil::wind
