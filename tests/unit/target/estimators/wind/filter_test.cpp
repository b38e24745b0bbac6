// step() as a whole: order of operations, time base, start, algorithms, reported values.
#include "target/estimators/wind/filter.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/target/estimators/wind/flown.hpp"

namespace canhil::wind {
namespace {

using Eigen::Vector3d;

double mean_nis(const Flown& flown) {
  double sum = 0;
  for (const UpdateResult& result : flown.results) sum += result.nis;
  return sum / static_cast<double>(flown.results.size());
}

TEST(WindFilter, StepIsPredictionThenUpdate) {
  const RecordedRun run;
  const Design design = make_design(run.settings);
  State state = run.release();
  FinHistory fins;
  fins.push(0, run.inputs[0].fins, 1);
  const UpdateResult first = step(state, run.navigation(0), fins, design);
  fins.push(20'000, run.inputs[1].fins, 1);
  const UpdateResult second = step(state, run.navigation(1), fins, design);

  StateVector x = run.x0;
  Covariance P = run.P0;
  update(x, P, run.y[0], 0.02, design);
  Inputs inputs = run.inputs[0];
  const Deflection &a = run.inputs[0].fins, &b = run.inputs[1].fins;
  inputs.fins = {(a.elevator + b.elevator) / 2, (a.aileron + b.aileron) / 2, (a.rudder + b.rudder) / 2};
  RangeFlags outside;
  predict(x, P, 0.02, inputs, run.settings.density, design, outside);
  const Answer answer = update(x, P, run.y[1], 0.02, design);
  EXPECT_EQ(first.outcome, Outcome::updated);
  EXPECT_EQ(second.outcome, Outcome::updated);
  EXPECT_LT((state.x - x).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((state.P - P).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(second.innovation, answer.innovation);
  EXPECT_NEAR(second.nis, answer.nis, 1e-9 * answer.nis);
  EXPECT_EQ(state.t_us, 20'000);
  EXPECT_EQ(state.altitude, run.altitude[1]);
}

// The published P0 assumes that the wind is computed from air velocity, attitude and ground velocity.
TEST(WindFilter, StartIsThePublishedOne) {
  const RecordedRun run;
  Start start;
  start.air_velocity = run.x0.head<3>();
  start.omega = run.x0.segment<3>(3);
  start.attitude = run.x0.segment<3>(6);
  start.v_eb_n = ground_velocity(run.x0).C_v_a + run.x0.tail<3>();
  start.altitude = run.altitude[0];
  const State state = initial(start, make_design(run.settings));
  EXPECT_LT((state.x - run.x0).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((state.P - run.P0).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_TRUE(filtering::is_positive_definite<12>(state.P));
}

TEST(WindFilter, DefaultsFollowTheWind) {
  const RecordedRun run;
  const Flown flown = fly(run, Settings());
  for (const UpdateResult& result : flown.results) {
    EXPECT_EQ(result.outcome, Outcome::updated);
    EXPECT_EQ(result.fault, Fault::none);
    EXPECT_FALSE(result.flags.degraded() || result.flags.fins_late);
  }
  for (const State& state : flown.states) EXPECT_TRUE(filtering::is_positive_definite<12>(state.P));
  EXPECT_LT(flown.mean_error(500, 1001), 1.5);
}

TEST(WindFilter, EveryChoiceStaysPositiveDefinite) {
  const RecordedRun run;
  for (const Algorithm algorithm : {Algorithm::ekf, Algorithm::h_infinity, Algorithm::adaptive_q}) {
    for (const ProcessNoise noise :
         {ProcessNoise::block_diagonal, ProcessNoise::correlated, ProcessNoise::aerodynamic}) {
      Settings settings = run.settings;
      settings.algorithm = algorithm;
      settings.process_noise = noise;
      const Flown flown = fly(run, settings);
      for (const State& state : flown.states) {
        ASSERT_TRUE(filtering::is_positive_definite<12>(state.P));
        ASSERT_EQ(state.P, state.P.transpose());
      }
      EXPECT_EQ(flown.results.back().outcome, Outcome::updated);
    }
  }
}

// The filter starts with the published noise, which is too small. With adaptive noise, the mean NIS falls
// nearly to its 9 degrees of freedom, and the error falls too.
TEST(WindFilter, AdaptiveNoiseMakesTheStatisticConsistent) {
  const RecordedRun run;
  Settings settings = run.settings;
  const Flown tight = fly(run, settings);
  settings.algorithm = Algorithm::adaptive_q;
  const Flown adaptive = fly(run, settings);
  EXPECT_GT(mean_nis(tight), 2 * 9);
  EXPECT_NEAR(mean_nis(adaptive), 9.6, 0.4);  // three sigma of 1001 updates: 3 sqrt(2 * 9 / 1001)
  EXPECT_LT(adaptive.mean_error(500, 1001), tight.mean_error(500, 1001));
  EXPECT_GT(adaptive.states.back().noise_factor, 3);
  for (const State& state : tight.states) EXPECT_EQ(state.noise_factor, 1);
}

// A gap is predicted in parts, each with the fins of its own time. The result is nearly the same as that of
// the run without a gap.
TEST(WindFilter, LostNavigationIsBridged) {
  const RecordedRun run;
  const Settings settings;
  const Design design = make_design(settings);
  const Flown whole = fly(run, settings);
  State state = whole.states[700];
  FinHistory fins;
  for (std::size_t k = 695; k <= 705; ++k) fins.push(RecordedRun::t_us(k), run.inputs[k].fins, 1);
  const UpdateResult result = step(state, run.navigation(705), fins, design);
  EXPECT_EQ(result.outcome, Outcome::updated);
  EXPECT_FALSE(result.flags.fins_late);
  EXPECT_LT((state.x.tail<3>() - whole.states[705].x.tail<3>()).norm(), 0.5);
  EXPECT_LT((state.x.segment<3>(rate_at) - whole.states[705].x.segment<3>(rate_at)).norm(), 0.02);
}

TEST(WindFilter, UsesTheFinsThatActedOverTheStep) {
  const RecordedRun run;
  Settings settings = run.settings;
  const double on_time = fly(run, settings).mean_error(100, 1001);
  const double late = fly(run, settings, [](std::size_t, Navigation&, FinFrame& frame) {
                        frame.t_us +=
                            100'000;  // a time stamp of the frame's arrival in place of its validity
                      }).mean_error(100, 1001);
  EXPECT_LT(on_time, 0.8 * late);
}

// Without initial knowledge of the wind, the filter still finds it.
TEST(WindFilter, StartsWithoutKnowledgeOfTheWind) {
  const RecordedRun run;
  const Design design = make_design(Settings());
  State state = initial(design, Vector3d(0, 50, 0));
  FinHistory fins;
  for (std::size_t k = 0; k < run.y.size(); ++k) {
    fins.push(RecordedRun::t_us(k), run.inputs[k].fins, 1);
    const UpdateResult result = step(state, run.navigation(k), fins, design);
    ASSERT_EQ(result.outcome, k == 0 ? Outcome::started : Outcome::updated);
    ASSERT_TRUE(filtering::is_positive_definite<12>(state.P));
  }
  EXPECT_LT((state.x.tail<3>() - run.true_wind(1000)).norm(), 2.5);
}

TEST(WindEstimate, WindBlowsFromItsDirection) {
  const auto from = [](double north, double east) {
    StateVector x = StateVector::Zero();
    x(wind_at) = north;
    x(wind_at + 1) = east;
    return estimate(x).wind_from / rad_per_deg;
  };
  EXPECT_NEAR(from(0, 10), 270, 1e-12);  // a west wind
  EXPECT_NEAR(from(-10, 0), 0, 1e-12);
  EXPECT_NEAR(from(10, 0), 180, 1e-12);
  EXPECT_NEAR(from(-10, -10), 45, 1e-12);
  EXPECT_LT(from(-10, 1e-30), 360);
  EXPECT_EQ(from(0, 0), 0);
}

TEST(WindEstimate, SigmasAreOfSpeedDirectionAndTrack) {
  StateVector x = StateVector::Zero();
  x.head<3>() << 200, 0, 0;
  x(attitude_at + 2) = std::numbers::pi / 2;  // east
  x.tail<3>() << 0, 20, 0;                    // a tail wind
  Covariance P = Covariance::Zero();
  P.diagonal().tail<3>() << 0.04, 9, 1;
  const Uncertainty u = uncertainty(x, P);
  EXPECT_NEAR(u.along_track, 3, 1e-12);
  EXPECT_NEAR(u.cross_track, 0.2, 1e-12);
  EXPECT_NEAR(u.wind_speed, 3, 1e-12);
  EXPECT_NEAR(u.wind_from, 0.2 / 20, 1e-12);
  EXPECT_NEAR(u.state(wind_at + 1), 3, 1e-12);
  x.tail<3>().setZero();
  EXPECT_NEAR(uncertainty(x, P).wind_from, std::numbers::pi / std::numbers::sqrt3, 1e-12);
}

// Most of the uncertainty of the wind lies along the air velocity, not along the ground track.
TEST(WindEstimate, AlongTrackIsWhereTheUncertaintyLies) {
  const RecordedRun run;
  const State state = fly(run, Settings()).states[900];
  const Uncertainty u = uncertainty(state);
  EXPECT_GT(u.along_track, 1.5 * u.cross_track);
  const Estimate e = estimate(state);
  EXPECT_NEAR(e.air_speed, state.x.head<3>().norm(), 1e-12);
  EXPECT_NEAR(e.wind_from / rad_per_deg, 264, 6);
}

}  // namespace
}  // namespace canhil::wind
