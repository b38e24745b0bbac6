// Temporary bad input is flagged, bridged, and has no lasting effect; nothing becomes NaN.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/target/estimators/wind/flown.hpp"

namespace canhil::wind {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t bad_from = 500, bad_to = 550;  // 1 s

bool is_bad(std::size_t k) { return k >= bad_from && k < bad_to; }

const RecordedRun& recorded() {
  static const RecordedRun run;
  return run;
}

void expect_sound(const Flown& flown) {
  for (std::size_t k = 0; k < flown.states.size(); ++k) {
    ASSERT_TRUE(flown.states[k].x.allFinite() && flown.states[k].P.allFinite()) << k;
    ASSERT_TRUE(filtering::is_positive_definite<12>(flown.states[k].P)) << k;
  }
}

// The filter has recovered: the last samples are used and have no error flag, and the wind is as accurate as
// without the fault.
void expect_recovered(const Flown& flown, double margin = 0.5) {
  static const double undisturbed = fly(recorded(), Settings()).mean_error(900, 1001);
  for (std::size_t k = 900; k < 1001; ++k) {
    ASSERT_EQ(flown.results[k].outcome, Outcome::updated) << k;
    ASSERT_EQ(flown.results[k].fault, Fault::none) << k;
    ASSERT_FALSE(flown.results[k].flags.degraded()) << k;
  }
  EXPECT_LT(flown.mean_error(900, 1001), undisturbed + margin);
}

Flown fly_with(const std::function<void(Navigation&, FinFrame&)>& spoil) {
  return fly(recorded(), Settings(), [&spoil](std::size_t k, Navigation& navigation, FinFrame& fins) {
    if (is_bad(k)) spoil(navigation, fins);
  });
}

void expect_coasting(const Flown& flown, Fault fault) {
  expect_sound(flown);
  for (std::size_t k = bad_from; k < bad_to; ++k) {
    ASSERT_EQ(flown.results[k].outcome, Outcome::coasting) << k;
    ASSERT_EQ(flown.results[k].fault, fault) << k;
    ASSERT_EQ(flown.results[k].nis, 0) << k;
  }
  EXPECT_EQ(flown.results[bad_to].outcome, Outcome::updated);
  EXPECT_GT(flown.states[bad_to - 1].P(wind_at, wind_at), flown.states[bad_from - 1].P(wind_at, wind_at));
  expect_recovered(flown);
}

TEST(WindBadInput, NavigationThatSaysItIsInvalid) {
  expect_coasting(fly_with([](Navigation& n, FinFrame&) { n.valid = false; }), Fault::invalid);
}

TEST(WindBadInput, NavigationThatIsNotFinite) {
  expect_coasting(fly_with([](Navigation& n, FinFrame&) { n.v_eb_n.y() = nan; }), Fault::not_finite);
  expect_coasting(fly_with([](Navigation& n, FinFrame&) { n.omega.x() = infinity; }), Fault::not_finite);
  expect_coasting(fly_with([](Navigation& n, FinFrame&) { n.attitude.z() = nan; }), Fault::not_finite);
  expect_coasting(fly_with([](Navigation& n, FinFrame&) { n.altitude = nan; }), Fault::not_finite);
}

TEST(WindBadInput, NavigationThatIsNotPhysical) {
  expect_coasting(fly_with([](Navigation& n, FinFrame&) { n.v_eb_n.x() = 1e200; }), Fault::not_physical);
  expect_coasting(fly_with([](Navigation& n, FinFrame&) { n.omega.z() = 50; }), Fault::not_physical);
  expect_coasting(fly_with([](Navigation& n, FinFrame&) { n.attitude.z() = 8; }), Fault::not_physical);
}

TEST(WindBadInput, PitchNearThePole) {
  for (const double pitch : {1.55, -1.57, std::numbers::pi / 2})
    expect_coasting(fly_with([pitch](Navigation& n, FinFrame&) { n.attitude.y() = pitch; }), Fault::pitch);
}

TEST(WindBadInput, StaleNavigation) {
  Navigation kept;
  const Flown flown = fly(recorded(), Settings(), [&kept](std::size_t k, Navigation& n, FinFrame&) {
    if (k == bad_from) kept = n;
    if (!is_bad(k)) return;
    const std::int64_t t_us = n.t_us;
    n = kept;
    n.t_us = t_us;
  });
  expect_sound(flown);
  EXPECT_EQ(flown.results[bad_from + 4].outcome, Outcome::updated);  // so few equal samples may be chance
  for (std::size_t k = bad_from + 6; k < bad_to; ++k) {
    ASSERT_EQ(flown.results[k].outcome, Outcome::coasting) << k;
    ASSERT_EQ(flown.results[k].fault, Fault::stale) << k;
  }
  EXPECT_EQ(flown.results[bad_to].outcome, Outcome::updated);
  expect_recovered(flown);
}

TEST(WindBadInput, TimeThatStandsStillOrRunsBack) {
  const Flown flown = fly(recorded(), Settings(), [](std::size_t k, Navigation& n, FinFrame&) {
    if (is_bad(k)) n.t_us = RecordedRun::t_us(k % 2 == 0 ? bad_from - 1 : 3);
  });
  for (std::size_t k = bad_from; k < bad_to; ++k) {
    ASSERT_EQ(flown.results[k].outcome, Outcome::out_of_order) << k;
    ASSERT_EQ(flown.states[k].x, flown.states[bad_from - 1].x) << k;
  }
  EXPECT_EQ(flown.results[bad_to].outcome, Outcome::updated);
  expect_sound(flown);
  expect_recovered(flown);
}

TEST(WindBadInput, JumpOfTheGroundVelocity) {
  const Flown flown = fly(recorded(), Settings(), [](std::size_t k, Navigation& n, FinFrame&) {
    if (k >= bad_from && k < bad_from + 20) n.v_eb_n.y() += 300;
  });
  expect_sound(flown);
  for (std::size_t k = bad_from; k < bad_from + 20; ++k) {
    ASSERT_EQ(flown.results[k].outcome, Outcome::coasting) << k;
    ASSERT_EQ(flown.results[k].fault, Fault::jump) << k;
  }
  EXPECT_EQ(flown.results[bad_from + 20].outcome, Outcome::updated);
  expect_recovered(flown);
}

// Input that contradicts the filter persistently is accepted in the end.
TEST(WindBadInput, LastingJumpStartsTheFilterAgain) {
  const Flown flown = fly(recorded(), Settings(), [](std::size_t k, Navigation& n, FinFrame&) {
    if (k >= bad_from) n.attitude.z() += 1.0;
  });
  expect_sound(flown);
  const auto last_jump = static_cast<std::size_t>(Settings().jumps_limit) - 1;
  EXPECT_EQ(flown.results[bad_from + last_jump - 1].outcome, Outcome::coasting);
  EXPECT_EQ(flown.results[bad_from + last_jump].outcome, Outcome::started);
  EXPECT_EQ(flown.results[1000].outcome, Outcome::updated);
}

TEST(WindBadInput, LongOutageStartsAgainWithTheWindThatWasKnown) {
  const Flown flown = fly(recorded(), Settings(), [](std::size_t k, Navigation& n, FinFrame&) {
    n.valid = k < 400 || k >= 600;  // invalid for 4 s
  });
  expect_sound(flown);
  EXPECT_EQ(flown.results[498].outcome, Outcome::coasting);
  EXPECT_EQ(flown.results[501].outcome, Outcome::waiting);
  EXPECT_FALSE(flown.states[599].started);
  EXPECT_EQ(flown.results[600].outcome, Outcome::started);
  EXPECT_EQ(flown.results[601].outcome, Outcome::updated);
  EXPECT_GT(flown.states[599].P(wind_at, wind_at), flown.states[501].P(wind_at, wind_at) + 0.15);
  expect_recovered(flown, 1.0);
}

TEST(WindBadInput, FramesThatDoNotComeAtAll) {
  const Design design = make_design(Settings());
  State state = recorded().release();
  FinHistory fins;
  fins.push(0, recorded().inputs[0].fins, 1);
  step(state, recorded().navigation(0), fins, design);
  EXPECT_EQ(step(state, recorded().navigation(400), fins, design).outcome, Outcome::started);  // 8 s later
  EXPECT_TRUE(state.x.allFinite());
  EXPECT_TRUE(filtering::is_positive_definite<12>(state.P));
}

TEST(WindBadInput, AltitudeOutsideTheAtmosphere) {
  for (const double altitude : {-5000.0, 60'000.0, 1e300}) {
    const Flown flown = fly_with([altitude](Navigation& n, FinFrame&) { n.altitude = altitude; });
    expect_sound(flown);
    for (std::size_t k = bad_from + 1; k <= bad_to; ++k) {  // the step after each bad sample
      ASSERT_TRUE(flown.results[k].flags.outside.altitude) << k;
      ASSERT_TRUE(flown.results[k].flags.degraded()) << k;
      ASSERT_EQ(flown.results[k].outcome, Outcome::updated) << k;
    }
    EXPECT_FALSE(flown.results[bad_to + 1].flags.outside.altitude);
    expect_recovered(flown);
  }
}

TEST(WindBadInput, DeflectionThatIsNotPhysical) {
  for (const double angle : {nan, infinity, 0.8, -1e300}) {
    const Flown flown = fly_with([angle](Navigation&, FinFrame& fins) { fins.deflection.aileron = angle; });
    expect_sound(flown);
    for (std::size_t k = bad_from; k < bad_to; ++k) {
      ASSERT_TRUE(flown.results[k].flags.fins_not_physical) << k;
      ASSERT_EQ(flown.results[k].outcome, Outcome::updated) << k;
    }
    EXPECT_FALSE(flown.results[bad_from + 1].flags.fins_missing);
    EXPECT_TRUE(flown.results[bad_from + 10].flags.fins_missing);
    EXPECT_FALSE(flown.results[bad_to].flags.fins_not_physical);
    expect_recovered(flown);
  }
}

TEST(WindBadInput, OneMissedFinFrameIsFlaggedLate) {
  const Flown flown = fly(recorded(), Settings(),
                          [](std::size_t k, Navigation&, FinFrame& fins) { fins.arrives = k != bad_from; });
  EXPECT_FALSE(flown.results[bad_from - 1].flags.fins_late);
  EXPECT_TRUE(flown.results[bad_from + 1].flags.fins_late);  // the next fin frame bridges the gap
  EXPECT_FALSE(flown.results[bad_from + 2].flags.fins_late);
  for (const UpdateResult& result : flown.results) EXPECT_FALSE(result.flags.fins_missing);
  expect_recovered(flown);
}

// The process noise does not adapt here, so that only its increase for missing fins is visible.
Settings constant_noise() {
  Settings settings;
  settings.algorithm = Algorithm::ekf;
  settings.process_noise = ProcessNoise::block_diagonal;
  settings.density.rate = 0.5 * rad_per_deg;
  return settings;
}

TEST(WindBadInput, MissingFinsWidenTheUncertainty) {
  const Flown flown = fly(recorded(), constant_noise(), [](std::size_t k, Navigation&, FinFrame& fins) {
    fins.arrives = k < bad_from || k >= bad_to;
  });
  expect_sound(flown);
  EXPECT_TRUE(flown.results[bad_from + 1].flags.fins_late);
  EXPECT_FALSE(flown.results[bad_from + 1].flags.fins_missing);
  EXPECT_TRUE(flown.results[bad_to - 1].flags.fins_missing);
  EXPECT_GT(flown.states[bad_to - 1].P(rate_at, rate_at), 2 * flown.states[bad_from - 1].P(rate_at, rate_at));
  expect_recovered(flown);
}

// Fins are missing from the start. Every step must have the flag, and the states must stay finite with a
// positive definite P.
TEST(WindBadInput, NoFinsAtAll) {
  const Flown flown =
      fly(recorded(), Settings(), [](std::size_t, Navigation&, FinFrame& fins) { fins.arrives = false; });
  expect_sound(flown);
  for (std::size_t k = 1; k < 1001; ++k) ASSERT_TRUE(flown.results[k].flags.fins_missing) << k;
}

TEST(WindBadInput, AirVelocityOutsideTheTable) {
  struct Case {
    Eigen::Vector3d v_a;
    bool RangeFlags::*flag;
  };
  const Case cases[] = {{{20, 0, 1}, &RangeFlags::speed},    {{0, 0, 0}, &RangeFlags::speed},
                        {{700, 0, 10}, &RangeFlags::speed},  {{320, 0, 10}, &RangeFlags::mach},
                        {{100, 0, 90}, &RangeFlags::alpha},  {{-200, 0, 0}, &RangeFlags::alpha},
                        {{150, 140, 10}, &RangeFlags::beta}, {{0, 250, 0}, &RangeFlags::beta},
                        {{0, 0, -250}, &RangeFlags::alpha}};
  for (const Case& c : cases) {
    Settings settings;
    for (const Algorithm algorithm : {Algorithm::ekf, Algorithm::h_infinity, Algorithm::adaptive_q}) {
      settings.algorithm = algorithm;
      const Design design = make_design(settings);
      Start start;
      start.air_velocity = c.v_a;
      start.attitude.setZero();
      start.omega.setZero();
      start.v_eb_n = c.v_a;
      start.altitude = 9000;
      State state = initial(start, design);
      FinHistory fins;
      for (int k = 0; k <= 50; ++k) {
        fins.push(k * 20'000L, {}, 1);
        const Navigation n{.t_us = k * 20'000L,
                           .v_eb_n = start.v_eb_n + Eigen::Vector3d(0.001 * k, 0, 0),
                           .omega = start.omega,
                           .attitude = start.attitude,
                           .altitude = 9000,
                           .valid = true};
        const UpdateResult result = step(state, n, fins, design);
        ASSERT_TRUE(result.outcome == Outcome::updated || result.outcome == Outcome::started)
            << c.v_a.transpose() << " at " << k;
        if (k == 1) {
          EXPECT_TRUE(result.flags.outside.*c.flag) << c.v_a.transpose();
        }
        ASSERT_TRUE(state.x.allFinite() && state.P.allFinite()) << c.v_a.transpose();
      }
    }
  }
}

TEST(WindBadInput, NoiseIsRaisedWhereTheModelEnds) {
  const Design design = make_design(constant_noise());
  const auto rate_variance = [&design](double u) {
    StateVector x = StateVector::Zero();
    x(0) = u;
    Covariance P = 1e-12 * Covariance::Identity();
    RangeFlags outside;
    predict(x, P, 0.02, {{}, standard_atmosphere(9000)}, design.settings.density, design, outside);
    EXPECT_EQ(outside.speed, u < 60);
    return P(rate_at, rate_at);
  };
  EXPECT_NEAR(rate_variance(61), std::pow(0.5 * rad_per_deg, 2) * 0.02, 1e-9);
  EXPECT_NEAR(rate_variance(59), std::pow(10 * rad_per_deg, 2) * 0.02, 1e-9);
}

TEST(WindBadInput, BrokenStateStartsAgain) {
  const Design design = make_design(Settings());
  State state = recorded().release();
  state.P(4, 4) = nan;
  FinHistory fins;
  EXPECT_EQ(step(state, recorded().navigation(0), fins, design).outcome, Outcome::non_finite);
  EXPECT_TRUE(state.x.allFinite() && state.P.allFinite());
  EXPECT_EQ(step(state, recorded().navigation(1), fins, design).outcome, Outcome::started);
  EXPECT_EQ(step(state, recorded().navigation(2), fins, design).outcome, Outcome::updated);
  EXPECT_TRUE(filtering::is_positive_definite<12>(state.P));
}

}  // namespace
}  // namespace canhil::wind
