// Unusable input is reported and bridged with growing sigmas; the output is never NaN, and the filter
// recovers.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "target/estimators/los_rate/filter.hpp"
#include "tests/unit/target/estimators/los_rate/engagement.hpp"

namespace canhil::los_rate {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr std::array algorithms{Algorithm::switched_table, Algorithm::combined, Algorithm::kalman,
                                Algorithm::low_pass};

bool finite(const State& state) {
  const Estimate x = estimate(state);
  const std::array values{x.error.pitch,        x.error.yaw,        x.rate.pitch,         x.rate.yaw,
                          x.acceleration.pitch, x.acceleration.yaw, state.track.now.range};
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}
bool finite(const Sigma& sigma) {
  return std::isfinite(sigma.error) && std::isfinite(sigma.rate) && std::isfinite(sigma.acceleration);
}

struct Breakage {
  std::string name;
  Fault fault;
  std::function<void(Measurement&)> apply;
  bool concerns_low_pass;  // low_pass needs neither range nor missile acceleration
};

std::vector<Breakage> breakages() {
  return {
      {"error flagged", Fault::error_angle, [](Measurement& m) { m.error_valid = false; }, true},
      {"error NaN", Fault::error_angle, [](Measurement& m) { m.error.yaw = nan; }, true},
      {"out of view", Fault::field_of_view,
       [](Measurement& m) {
         m.error = {0.15, -0.15};
       },
       true},
      {"error huge", Fault::field_of_view, [](Measurement& m) { m.error.pitch = 1e300; }, true},
      {"antenna flagged", Fault::antenna, [](Measurement& m) { m.antenna_valid = false; }, true},
      {"antenna NaN", Fault::antenna, [](Measurement& m) { m.antenna_increment.pitch = nan; }, true},
      {"roll infinite", Fault::antenna, [](Measurement& m) { m.roll_increment = inf; }, true},
      {"acceleration flagged", Fault::acceleration, [](Measurement& m) { m.acceleration_valid = false; },
       false},
      {"acceleration NaN", Fault::acceleration, [](Measurement& m) { m.missile_acceleration.yaw = nan; },
       false},
      {"range flagged", Fault::range_invalid, [](Measurement& m) { m.range.range_valid = false; }, false},
      {"range zero", Fault::range_invalid, [](Measurement& m) { m.range.range = 0; }, false},
      {"range negative", Fault::range_invalid, [](Measurement& m) { m.range.range = -3000; }, false},
      {"range NaN", Fault::range_invalid, [](Measurement& m) { m.range.range = nan; }, false},
      {"range infinite", Fault::range_invalid, [](Measurement& m) { m.range.range = inf; }, false},
      {"speed flagged", Fault::closing_speed_invalid,
       [](Measurement& m) { m.range.closing_speed_valid = false; }, false},
      {"speed zero", Fault::closing_speed_invalid, [](Measurement& m) { m.range.closing_speed = 0; }, false},
      {"speed negative", Fault::closing_speed_invalid, [](Measurement& m) { m.range.closing_speed = -900; },
       false},
      {"speed NaN", Fault::closing_speed_invalid, [](Measurement& m) { m.range.closing_speed = nan; }, false},
  };
}

// From 2.6 s to 2.3 s before the closest approach, every sample is invalid.
TEST(BadInput, IsNamedCoastedOverAndRecoveredFrom) {
  for (const Algorithm algorithm : algorithms) {
    for (const Breakage& breakage : breakages()) {
      SCOPED_TRACE(breakage.name + ", algorithm " + std::to_string(static_cast<int>(algorithm)));
      EngagementSetup setup;
      setup.settings.algorithm = algorithm;
      setup.noisy = true;
      const Design design = make_design(setup.settings);
      Engagement engagement(setup);
      State state = initial();
      Sigma before, last;
      int coasted = 0, recovered = 0;
      const bool coasts = algorithm != Algorithm::low_pass || breakage.concerns_low_pass;
      while (!engagement.over()) {
        Measurement m = engagement.next();
        const double to_go = engagement.truth().time_to_go;
        const bool broken = to_go < 2.6 && to_go > 2.3;
        if (broken) breakage.apply(m);
        const UpdateResult result = step(state, m, design);
        ASSERT_TRUE(finite(state) && finite(result.sigma.pitch) && finite(result.sigma.yaw)) << to_go;
        if (to_go > 2.6) before = last = result.sigma.pitch;
        if (broken) {
          ASSERT_EQ(result.fault, breakage.fault) << to_go;
          ASSERT_EQ(result.outcome, coasts ? Outcome::coasting : Outcome::updated) << to_go;
          ASSERT_EQ(result.nis == 0, coasts);
          if (coasts) {
            ASSERT_GT(result.sigma.pitch.rate, last.rate) << to_go;
            ASSERT_GT(result.sigma.pitch.error, last.error) << to_go;
            last = result.sigma.pitch;
          }
          ++coasted;
        }
        if (to_go < 2.29) {
          EXPECT_NE(result.outcome, Outcome::coasting) << to_go;
          EXPECT_EQ(result.fault, Fault::none);
        }
        if (to_go < 1.3 && to_go > 1) {
          const double error = std::abs(state.rate - engagement.truth().rate);
          EXPECT_LT(error, algorithm == Algorithm::low_pass ? 0.02 : 0.01);
          ++recovered;
        }
      }
      EXPECT_NEAR(coasted, 60, 1);
      EXPECT_NEAR(recovered, 60, 1);
      if (coasts) {
        EXPECT_GT(last.rate, 1.3 * before.rate);
      }
    }
  }
}

// The sigma must be correct during a coast: over 60 lost samples, errors and sigmas agree on average.
TEST(BadInput, SigmasOfACoastAreConsistent) {
  for (const Algorithm algorithm : {Algorithm::kalman, Algorithm::combined}) {
    double ratio = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
      EngagementSetup setup;
      setup.settings.algorithm = algorithm;
      setup.noisy = true;
      setup.seed = seed;
      setup.jerk_density = 300;
      const Design design = make_design(setup.settings);
      Engagement engagement(setup);
      State state = initial();
      UpdateResult result;
      do {
        Measurement m = engagement.next();
        m.error_valid = engagement.truth().time_to_go > 1.5;
        result = step(state, m, design);
      } while (engagement.truth().time_to_go > 1.2);
      ASSERT_EQ(result.outcome, Outcome::coasting);
      ratio += std::norm(state.rate - engagement.truth().rate) / (2 * std::pow(result.sigma.pitch.rate, 2));
    }
    EXPECT_NEAR(ratio / 200, 1, 0.25) << "chi-square of 400: 1 sigma is 0.07";
  }
}

struct Drive {
  Design design;
  State state = initial();
  double range = 5000;
  UpdateResult sample(double measured_range, double speed) {
    Measurement m{.dt = 0.005, .error_valid = true, .antenna_valid = true, .acceleration_valid = true};
    m.range = {measured_range, speed, true, true};
    range -= 4.5;
    return step(state, m, design);
  }
};

TEST(BadInput, AJumpOfRangeIsRefusedAndBelievedOnlyWhenItLasts) {
  Drive drive{make_design({})};
  for (int k = 0; k < 10; ++k) EXPECT_EQ(drive.sample(drive.range, 900).fault, Fault::none);
  EXPECT_EQ(drive.sample(drive.range + 500, 900).fault, Fault::range_jump);
  EXPECT_NEAR(drive.state.track.now.range, drive.range + 4.5, 1e-6) << "reckoned on";
  EXPECT_EQ(drive.sample(drive.range, 900).fault, Fault::none);
  EXPECT_EQ(drive.sample(drive.range, 1500).fault, Fault::range_jump) << "closing speed jumps";
  EXPECT_EQ(drive.sample(drive.range, 900).fault, Fault::none);
  // Samples that contradict one another are never accepted.
  for (int k = 0; k < 40; ++k)
    EXPECT_EQ(drive.sample(drive.range + 600 + 300 * (k % 2), 900).fault, Fault::range_jump);
  // If a range differs from the expected one for long enough, it is accepted as the new range.
  int refused = 0;
  while (drive.sample(drive.range + 2000, 900).fault == Fault::range_jump) ASSERT_LT(++refused, 30);
  EXPECT_EQ(refused, drive.design.settings.relock_samples);
  EXPECT_NEAR(drive.state.track.now.range, drive.range + 4.5 + 2000, 1e-6);
}

TEST(BadInput, ARangeThatStandsStillIsExtrapolatedThenStale) {
  Drive drive{make_design({})};
  for (int k = 0; k < 10; ++k) drive.sample(drive.range, 900);
  const double frozen = drive.range;
  int believed = 0;
  UpdateResult result;
  drive.sample(frozen, 900);
  while ((result = drive.sample(frozen, 900)).fault == Fault::none) {
    ++believed;
    EXPECT_NEAR(result.used.range, drive.range + 4.5, 1e-6) << "as old as it is unchanged";
    ASSERT_LT(believed, 100);
  }
  EXPECT_NEAR(believed, 20, 1);  // 0.1 s of samples
  EXPECT_EQ(result.fault, Fault::range_stale);
  EXPECT_EQ(result.outcome, Outcome::coasting);
  EXPECT_NEAR(result.used.range, drive.range + 4.5, 1e-6);
  EXPECT_EQ(drive.sample(drive.range, 900).fault, Fault::none) << "recovers at once";
}

TEST(BadInput, WaitsForRangeAndErrorAngle) {
  const Design design = make_design({});
  State state = initial();
  Measurement m{.dt = 0.005, .error_valid = true, .antenna_valid = true, .acceleration_valid = true};
  m.range = {4000, 900, false, true};
  EXPECT_EQ(step(state, m, design).outcome, Outcome::waiting);
  m.range.range_valid = true;
  m.error_valid = false;
  const UpdateResult result = step(state, m, design);
  EXPECT_EQ(result.outcome, Outcome::waiting);
  EXPECT_TRUE(finite(result.sigma.pitch));
  EXPECT_GT(result.sigma.pitch.rate, 0);
  m.error_valid = true;
  EXPECT_EQ(step(state, m, design).outcome, Outcome::started);
}

TEST(BadInput, AStepThatIsNoneLeavesTheStateAlone) {
  Drive drive{make_design({})};
  for (int k = 0; k < 10; ++k) drive.sample(drive.range, 900);
  for (const double dt : {0.0, -0.005, nan, inf, 0.6}) {
    Measurement m{.dt = dt, .error_valid = true, .antenna_valid = true, .acceleration_valid = true};
    m.error = {0.01, 0.01};
    m.range = {drive.range, 900, true, true};
    const State before = drive.state;
    EXPECT_EQ(step(drive.state, m, drive.design).outcome, Outcome::bad_step);
    EXPECT_EQ(drive.state.error, before.error);
    EXPECT_EQ(drive.state.track.now.range, before.track.now.range);
  }
}

// A finite but absurd value: the sample is refused as a whole.
TEST(BadInput, AResultThatOverflowsIsRefused) {
  Drive drive{make_design({})};
  for (int k = 0; k < 10; ++k) drive.sample(drive.range, 900);
  Measurement m{.dt = 0.005, .error_valid = true, .antenna_valid = true, .acceleration_valid = true};
  m.missile_acceleration.yaw = 1.7e308;
  m.antenna_increment.yaw = 1.7e308;
  m.range = {drive.range, 900, true, true};
  const State before = drive.state;
  EXPECT_EQ(step(drive.state, m, drive.design).outcome, Outcome::non_finite);
  EXPECT_EQ(drive.state.rate, before.rate);
  EXPECT_NE(drive.sample(drive.range, 900).outcome, Outcome::non_finite) << "and the next one serves";
}

// Below the least range, the transition would divide by a small r and the switched thermal gain would be
// unstable, so the transition and the gain use the least range.
TEST(BlindRange, RangeIsClampedAndSaidSo) {
  for (const Algorithm algorithm : algorithms) {
    EngagementSetup setup;
    setup.settings.algorithm = algorithm;
    setup.noisy = true;
    const Design design = make_design(setup.settings);
    Engagement engagement(setup);
    State state = initial();
    while (!engagement.over()) {
      const UpdateResult result = step(state, engagement.next(), design);
      const double r = engagement.truth().range;
      ASSERT_EQ(result.blind, r < 50) << r;
      ASSERT_EQ(result.used.range, std::max(r, 50.0));
      ASSERT_TRUE(finite(state));
    }
    // After the pass, neither the range nor the error angle is valid for a minute.
    Measurement m{.dt = 0.005, .antenna_valid = true, .acceleration_valid = true};
    double sigma = 0;
    for (int k = 0; k < 12'000; ++k) {
      const UpdateResult result = step(state, m, design);
      ASSERT_TRUE(finite(state) && finite(result.sigma.pitch)) << k;
      ASSERT_EQ(result.outcome, Outcome::coasting);
      ASSERT_TRUE(result.blind);
      ASSERT_GT(result.sigma.pitch.rate, sigma);
      sigma = result.sigma.pitch.rate;
    }
  }
}

TEST(BlindRange, IsTheLargestOfItsThreeRules) {
  Settings settings;
  EXPECT_EQ(least_range(settings, 900), 50);
  EXPECT_EQ(least_range(settings, 1800), 10 * 1800 * 0.005);
  settings.range_sigma = 40;
  EXPECT_EQ(least_range(settings, 1800), 120);
}

TEST(BadInput, RandomGarbageNeverLeavesANan) {
  std::mt19937_64 engine(3);
  const std::vector<double> values{0, 1, -1, 1e-3, -0.05, 900, 5000, 1e9, -1e300, 1e300, 1e-300, nan, inf};
  std::uniform_int_distribution<std::size_t> pick(0, values.size() - 1);
  std::bernoulli_distribution rarely(0.2), flag(0.8);
  for (const Algorithm algorithm : algorithms) {
    EngagementSetup setup;
    setup.settings.algorithm = algorithm;
    setup.settings.noise.yaw.glint = 0.7;
    const Design design = make_design(setup.settings);
    State state = initial();
    Engagement engagement(setup);
    for (int k = 0; k < 20'000; ++k) {
      if (engagement.over()) engagement = Engagement(setup);
      Measurement m = engagement.next();
      for (double* field : {&m.error.pitch, &m.error.yaw, &m.antenna_increment.pitch,
                            &m.antenna_increment.yaw, &m.roll_increment, &m.missile_acceleration.pitch,
                            &m.missile_acceleration.yaw, &m.range.range, &m.range.closing_speed, &m.dt})
        if (rarely(engine)) *field = values[pick(engine)];
      m.error_valid = flag(engine);
      m.antenna_valid = flag(engine);
      const UpdateResult result = step(state, m, design);
      ASSERT_TRUE(finite(state)) << k;
      if (result.outcome == Outcome::bad_step || result.outcome == Outcome::non_finite) continue;
      ASSERT_TRUE(finite(result.sigma.pitch) && finite(result.sigma.yaw)) << k;
      ASSERT_TRUE(std::isfinite(result.nis)) << k;
    }
  }
}

}  // namespace
}  // namespace canhil::los_rate
