// Lost samples: the motion of antenna and missile is bridged, and the gain corresponds to the longer step.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/target/estimators/los_rate/engagement.hpp"

namespace canhil::los_rate {
namespace {

constexpr std::array algorithms{Algorithm::switched_table, Algorithm::combined, Algorithm::kalman,
                                Algorithm::low_pass};

// The next sample that arrives after `lost` lost samples.
Measurement next_after(Engagement& engagement, int lost) {
  for (int k = 0; k < lost; ++k) engagement.next();
  Measurement m = engagement.next();
  m.interval = m.dt;
  m.dt *= lost + 1;
  return m;
}

struct Flown {
  EngagementSetup setup;
  Design design = make_design(setup.settings);
  Engagement engagement{setup};
  State state = initial();
};

// Flies without losses until this time to go [s].
Flown flown(Algorithm algorithm, double time_to_go) {
  Flown now{.setup = setup_of(algorithm)};
  while (now.engagement.truth().range == 0 || now.engagement.truth().time_to_go > time_to_go)
    step(now.state, now.engagement.next(), now.design);
  return now;
}

TEST(Gaps, AreBridgedWithTheMeanOfTheRatesBeforeAndAfter) {
  const Motion before{.antenna_rate = {0.1, 0.2}, .roll_rate = 1, .missile_acceleration = {10, -20}};
  const Motion after{.antenna_rate = {0.4, -0.2}, .roll_rate = 3, .missile_acceleration = {40, 20}};
  const Leg leg = bridge(before, after, 0.02);
  EXPECT_EQ(leg.dt, 0.02);
  EXPECT_LT(std::abs(leg.antenna_increment - Plane(0.005, 0)), 1e-15);
  EXPECT_DOUBLE_EQ(leg.roll_increment, 0.04);
  EXPECT_EQ(leg.missile_acceleration, Plane(25, 0));
  // The variance of the increment, summed over both planes. The rate changes suddenly by (0.3, -0.4) rad/s,
  // at a random time.
  double variance = 0;
  for (int k = 0; k < 1000; ++k) {
    const double share = (k + 0.5) / 1000;
    const Plane increment = 0.02 * (share * before.antenna_rate + (1 - share) * after.antenna_rate);
    variance += std::norm(increment - leg.antenna_increment) / 1000;
  }
  EXPECT_NEAR(2 * leg.turn * leg.turn / variance, 1, 1e-5);
  EXPECT_NEAR(leg.pull / leg.turn, 50 / 0.5, 1e-9) << "changes of 50 m/s^2 and 0.5 rad/s";
}

// The flight from 2.5 s to 0.2 s before the closest approach, with a turning missile, a tracking antenna and
// noise as modelled. One sample in ten is lost.
TEST(Gaps, CostLittleMoreThanTheSamplesThatAreGone) {
  for (const Algorithm algorithm : algorithms) {
    SCOPED_TRACE(static_cast<int>(algorithm));
    double squares[2] = {}, nis[2] = {};
    int updates[2] = {};
    for (const bool lossy : {false, true}) {
      for (unsigned seed = 301; seed <= 340; ++seed) {
        EngagementSetup setup = setup_of(algorithm);
        setup.noisy = true;
        setup.seed = seed;
        setup.jerk_density = 300;
        setup.first_rate = {20e-3, -10e-3};
        setup.roll_rate = 0.5;
        const Design design = make_design(setup.settings);
        Engagement engagement(setup);
        State state = initial();
        for (int k = 0; !engagement.over(); ++k) {
          const bool lost = lossy && k % 9 == 0 && k > 0;
          const UpdateResult result = step(state, next_after(engagement, lost ? 1 : 0), design);
          const Truth& truth = engagement.truth();
          if (truth.time_to_go > 2.5 || truth.time_to_go < 0.2) continue;
          ASSERT_EQ(result.outcome, Outcome::updated) << truth.time_to_go;
          ASSERT_EQ(result.fault, lost ? Fault::antenna : Fault::none);
          squares[lossy] += std::norm(state.rate - truth.rate) * std::pow(truth.range, 2);
          nis[lossy] += result.nis;
          ++updates[lossy];
        }
      }
    }
    const double cost = std::sqrt(squares[1] / updates[1] / (squares[0] / updates[0]));
    EXPECT_LT(cost, 1.1) << "1.05 for the tenth of the information that is gone";
    EXPECT_NEAR(nis[1] / updates[1], nis[0] / updates[0], 0.1) << "1 sigma of the mean is 0.02";
  }
}

// After a gap of 30 ms, the gain from error angle to LOS rate equals that of the Kalman filter.
TEST(Gaps, TheGainAfterOneIsThatOfTheLongerStep) {
  const auto gain = [](Algorithm algorithm, int lost) {
    auto [setup, design, engagement, state] = flown(algorithm, 0.3);
    Measurement m = next_after(engagement, lost);
    State other = state;
    step(state, m, design);
    m.error.yaw += 1e-3;
    step(other, m, design);
    return (other.rate - state.rate).real() / 1e-3;
  };
  for (const Algorithm algorithm : {Algorithm::switched_table, Algorithm::combined}) {
    const double kalman = gain(Algorithm::kalman, 6);
    EXPECT_NEAR(gain(algorithm, 6) / kalman, 1, 0.1);
    EXPECT_GT(kalman / gain(algorithm, 0), 1.25) << "the flight distinguishes the two";
  }
}

// If the sample after a gap does not contain the motion of antenna or missile, this motion is unknown. The
// variance of the angle then grows over the whole step, as for a gap that is too long.
TEST(Gaps, BeforeAnUnknownMotionAreNotBridged) {
  auto [setup, design, engagement, state] = flown(Algorithm::combined, 2.4);
  const Measurement whole = next_after(engagement, 4);
  Measurement no_antenna = whole, no_acceleration = whole;
  no_antenna.antenna_valid = false;
  no_acceleration.acceleration_valid = false;
  const double turn = setup.settings.antenna_rate_sigma * whole.dt;
  for (const Measurement& m : {no_antenna, no_acceleration}) {
    State next = state;
    const UpdateResult result = step(next, m, design);
    EXPECT_EQ(result.outcome, Outcome::coasting);
    EXPECT_GE(result.sigma.pitch.error, turn);
    EXPECT_LE(result.sigma.pitch.error, 1.1 * turn);
  }
  State next = state;
  EXPECT_LT(step(next, whole, design).sigma.pitch.error, turn / 2);
}

TEST(Gaps, LongerThanTheLimitOrAfterAnUnknownAntennaAreCoasted) {
  auto [setup, design, engagement, state] = flown(Algorithm::combined, 2.4);
  EXPECT_EQ(step(state, next_after(engagement, 9), design).outcome, Outcome::updated);
  EXPECT_EQ(step(state, next_after(engagement, 11), design).outcome, Outcome::coasting);
  EXPECT_EQ(step(state, engagement.next(), design).outcome, Outcome::start_up);
  Measurement unknown = engagement.next();
  unknown.antenna_valid = false;
  step(state, unknown, design);
  EXPECT_EQ(step(state, next_after(engagement, 1), design).outcome, Outcome::coasting);
  EXPECT_EQ(step(state, next_after(engagement, 1), design).outcome, Outcome::start_up);
}

}  // namespace
}  // namespace canhil::los_rate
