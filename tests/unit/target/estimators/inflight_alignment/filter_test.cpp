// Properties of the in-flight filters that can be tested without a reference.
#include "target/estimators/inflight_alignment/filter.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <numbers>

#include "target/estimators/filtering/cholesky.hpp"
#include "target/estimators/inflight_alignment/history.hpp"
#include "target/estimators/strapdown/attitude.hpp"
#include "tests/unit/target/estimators/inflight_alignment/recorded_run.hpp"

namespace canhil::inflight_alignment {
namespace {

using Eigen::Vector3d;

const RecordedRun& inputs(Aiding aiding) {
  static const RecordedRun ssbl(Aiding::ssbl), gps(Aiding::gps);
  return aiding == Aiding::ssbl ? ssbl : gps;
}

bool same_bits(const State& a, const State& b) {
  const bool same_errors = std::visit(
      [&]<int N>(const Errors<N>& errors) {
        const auto* same = std::get_if<Errors<N>>(&b.errors);
        return same != nullptr && same->x == errors.x && same->P == errors.P;
      },
      a.errors);
  return same_errors && a.ins.nav.C_bn == b.ins.nav.C_bn && a.ins.nav.v_eb_n == b.ins.nav.v_eb_n &&
         a.ins.nav.latitude == b.ins.nav.latitude && a.ins.nav.longitude == b.ins.nav.longitude &&
         a.ins.nav.height == b.ins.nav.height && a.accel_bias == b.accel_bias && a.gyro_bias == b.gyro_bias &&
         a.fix_bias == b.fix_bias && a.ins.interval.delta_v_n == b.ins.interval.delta_v_n &&
         a.ins.interval.duration == b.ins.interval.duration && a.ins.steps == b.ins.steps &&
         a.repairs == b.repairs && a.handed_over == b.handed_over;
}

double degrees_apart(double a, double b) {
  return std::abs(std::remainder(a - b, 2 * std::numbers::pi)) / rad_per_deg;
}

struct Case {
  Algorithm algorithm;
  Aiding aiding;
};
constexpr Case cases[] = {{Algorithm::ekf, Aiding::ssbl},     {Algorithm::ekf, Aiding::gps},
                          {Algorithm::ukf, Aiding::ssbl},     {Algorithm::ukf, Aiding::gps},
                          {Algorithm::sin_cos, Aiding::ssbl}, {Algorithm::sin_cos, Aiding::gps}};

// Acceptance limit D. In sin_cos, after the handover of the heading, the variance of k = 1 - cos psi may be
// zero; so is that of the fix bias of a GPS whose noise is white. All other variances must be positive.
TEST(InflightFilter, CovarianceIsSymmetricAndPositiveDefiniteThroughout) {
  for (const auto [algorithm, aiding] : cases) {
    for (const double start_deg : {90.0, 170.0}) {
      for (const bool closed : {false, true}) {
        RecordedRun from = inputs(aiding);
        from.start.C_bn = strapdown::exp_rotation({0, 0, (start_deg - 90) * rad_per_deg}) * from.start.C_bn;
        Settings settings = recorded_settings(algorithm, aiding);
        settings.heading_sigma_0 = (start_deg > 90 ? 120 : 90) * rad_per_deg;
        settings.closed_loop = closed;
        std::uint32_t repairs = 0;
        const State end =
            run(from, settings,
                [&, aiding_ = aiding](std::size_t k, const State& state, const UpdateResult& result) {
                  ASSERT_EQ(result.outcome, Outcome::ok);
                  repairs += static_cast<std::uint32_t>(result.repairs);
                  std::visit(
                      [&]<int N>(Errors<N> errors) {
                        ASSERT_TRUE(errors.P == errors.P.transpose());
                        if (N % 3 != 0 && errors.P(9, 9) == 0) errors.P(9, 9) = 1;
                        if (N == 19 && aiding_ == Aiding::gps)
                          errors.P.diagonal().template tail<3>().setOnes();
                        ASSERT_TRUE(filtering::is_positive_definite<N>(errors.P)) << k;
                      },
                      state.errors);
                });
        EXPECT_EQ(end.repairs, repairs);
        if (algorithm != Algorithm::ukf) {
          EXPECT_EQ(repairs, 0U);
        }
      }
    }
  }
}

// With the published platform frame, the reset rotates the tilts in P by the heading that is fed back. Open
// and closed loop then agree to second order: with SSBL and with GPS, the measured differences are 0.16 and
// 0.08 deg for the ekf. For the ukf, which draws its sigma points anew, they are 0.41 and 0.37 deg. Without
// the rotation, the differences of the ekf at the end are 2.4 and 4.7 deg.
TEST(InflightFilter, ClosedLoopWithItsResetEstimatesWhatTheOpenLoopDoes) {
  for (const auto [algorithm, aiding] : cases) {
    if (algorithm == Algorithm::sin_cos) continue;
    Settings open = recorded_settings(algorithm, aiding), closed = open;
    closed.closed_loop = true;
    const double expected = heading(run(inputs(aiding), open));
    const State end = run(inputs(aiding), closed);
    EXPECT_LT(degrees_apart(heading(end), expected), algorithm == Algorithm::ekf ? 0.25 : 0.6);
    std::visit([](const auto& errors) { EXPECT_TRUE(errors.x.isZero(0)); }, end.errors);
    if (algorithm == Algorithm::ukf) continue;
    closed.attitude_error_frame = AttitudeErrorFrame::navigation;
    EXPECT_GT(degrees_apart(heading(run(inputs(aiding), closed)), expected), 1);
  }
}

TEST(InflightFilter, SinCosFindsTheHeadingFromAnywhere) {
  for (const double start_deg : {0.0, 45.0, 90.0, 135.0, 180.0, -90.0}) {
    RecordedRun from = inputs(Aiding::ssbl);
    from.start.C_bn = strapdown::exp_rotation({0, 0, (start_deg - 90) * rad_per_deg}) * from.start.C_bn;
    Settings settings = recorded_settings(Algorithm::sin_cos, Aiding::ssbl);
    settings.heading_sigma_0 = 600 * rad_per_deg;
    const State end = run(from, settings);
    const Csv outputs(recorded("out_ssbl_sincos"));
    EXPECT_LT(degrees_apart(heading(end), outputs.at(outputs.rows() - 1, "heading_true")), 3) << start_deg;
    EXPECT_TRUE(end.handed_over);
    const double sigma = std::sqrt(uncertainty(end).attitude(2, 2));
    EXPECT_LT(sigma, settings.handover_sigma);
  }
}

// The tilts are up to 40 deg, with a configured sigma of 30 deg. The first sample levels the INS, so the run
// ends with the same heading and sigma as after a level start. Without this levelling, the heading of one run
// is off by 3.4 sigma at the end.
TEST(InflightFilter, SinCosFindsTheHeadingFromAnyTilt) {
  for (const double tilt_deg : {-40.0, 8.0, 40.0}) {
    RecordedRun from = inputs(Aiding::ssbl);
    const double tilt = tilt_deg * rad_per_deg;
    from.start.C_bn = strapdown::exp_rotation({tilt, -0.7 * tilt, 0}) * from.start.C_bn;
    Settings settings = recorded_settings(Algorithm::sin_cos, Aiding::ssbl);
    settings.tilt_sigma_0 = 30 * rad_per_deg;
    const State end = run(from, settings);
    const Csv outputs(recorded("out_ssbl_sincos"));
    const double sigma = std::sqrt(uncertainty(end).attitude(2, 2));
    EXPECT_LT(degrees_apart(heading(end), outputs.at(outputs.rows() - 1, "heading_true")) * rad_per_deg,
              3 * sigma)
        << tilt_deg;
    EXPECT_LT(sigma, settings.handover_sigma);
  }
}

// The vehicle accelerates at 1 m/s^2, so levelling by the first sample would tilt the INS by 6 deg. If the
// sigma of the initial tilts is smaller than 6 deg, the INS must not be levelled.
TEST(InflightFilter, OnlyAnUnknownTiltIsLevelled) {
  Settings settings = recorded_settings(Algorithm::sin_cos, Aiding::ssbl);
  const RecordedRun& from = inputs(Aiding::ssbl);
  settings.tilt_sigma_0 = 5 * rad_per_deg;
  EXPECT_FALSE(initial(from.start, settings).to_be_levelled);
  settings.tilt_sigma_0 = 10 * rad_per_deg;
  State state = initial(from.start, settings);
  EXPECT_TRUE(state.to_be_levelled);
  EXPECT_NEAR(std::sqrt(uncertainty(state).attitude(0, 0)), 1.1 / standard_gravity, 1e-12) << "margin 10 %";
  propagate(state, from.imu[0], settings);
  EXPECT_FALSE(state.to_be_levelled);
  const Vector3d force = state.ins.nav.C_bn * from.imu[0].delta_v;
  EXPECT_LT(force.head<2>().norm(), 1e-3 * force.norm()) << "but for the turn of the sample itself";
  EXPECT_LT(force.z(), 0);
}

State after_some_fixes(const Settings& settings, std::size_t samples = 25) {
  const RecordedRun& from = inputs(settings.aiding);
  State state = initial(from.start, settings);
  for (std::size_t i = 0; i < 3 * samples_per_fix + samples; ++i) {
    propagate(state, from.imu[i], settings);
    if ((i + 1) % samples_per_fix == 0) update(state, from.fixes[i / samples_per_fix], settings);
  }
  return state;
}

// The fix that the filter expects, shifted by these distances.
GeodeticPosition shifted(const State& state, double north_m, double east_m = 0, double down_m = 0) {
  const Estimate best = estimate(state);
  const Vector3d shift = best.fix_bias + Vector3d(north_m, east_m, down_m);
  return {best.nav.latitude + shift.x() / 6.36e6,
          best.nav.longitude + shift.y() / (6.38e6 * std::cos(best.nav.latitude)),
          best.nav.height - shift.z()};
}

TEST(InflightFilter, RefusedFixesLeaveTheStateAlone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto [algorithm, aiding] : cases) {
    const Settings settings = recorded_settings(algorithm, aiding);
    State state = initial(inputs(aiding).start, settings);
    EXPECT_EQ(update(state, shifted(state, 0), settings).outcome, Outcome::no_interval);
    state = after_some_fixes(settings);
    const State before = state;
    EXPECT_EQ(update(state, GeodeticPosition{nan, 0, 0}, settings).outcome, Outcome::non_finite);
    EXPECT_EQ(
        update(state, GeodeticPosition{0, 0, std::numeric_limits<double>::infinity()}, settings).outcome,
        Outcome::non_finite);
    EXPECT_TRUE(same_bits(state, before));
    EXPECT_EQ(update(state, shifted(state, 1), settings).outcome, Outcome::ok) << "and the next one serves";
    EXPECT_EQ(update(state, shifted(state, 1), settings).outcome, Outcome::no_interval) << "but once";
  }
}

TEST(InflightFilter, AFixBeyondTheGateIsRefusedUntilTooManyAre) {
  for (const auto [algorithm, aiding] : cases) {
    Settings settings = recorded_settings(algorithm, aiding);
    settings.gate_nis = 30;
    settings.gate_recovery = 2;
    State state = after_some_fixes(settings);
    const State before = state;
    for (std::uint32_t i = 1; i <= 2; ++i) {
      const UpdateResult result = update(state, shifted(state, 1000), settings);
      EXPECT_EQ(result.outcome, Outcome::gated);
      EXPECT_GT(result.nis, 30);
      EXPECT_EQ(state.rejected, i);
    }
    EXPECT_TRUE(same_bits(state, before));
    State other = state;
    EXPECT_EQ(update(other, shifted(state, 1), settings).outcome, Outcome::ok);
    EXPECT_EQ(other.rejected, 0U);
    const UpdateResult opened = update(state, shifted(state, 1000), settings);
    EXPECT_EQ(opened.outcome, Outcome::ok);
    EXPECT_TRUE(opened.gate_opened);
  }
}

// z = dR - rho: if the fix is north of the INS, either the INS is too far south or the fix has a bias to the
// north.
TEST(InflightFilter, AFixMovesPositionAndBiasTowardsItself) {
  for (const auto [algorithm, aiding] : cases) {
    const Settings settings = recorded_settings(algorithm, aiding);
    State state = initial(inputs(aiding).start, settings);  // before the first fix P is still diagonal
    for (std::size_t k = 0; k < 10; ++k) propagate(state, inputs(aiding).imu[k], settings);
    const Estimate before = estimate(state);
    const UpdateResult result = update(state, shifted(state, 3, -4, 5), settings);
    ASSERT_EQ(result.outcome, Outcome::ok);
    const Estimate after = estimate(state);
    EXPECT_GT(after.nav.latitude, before.nav.latitude);
    EXPECT_LT(after.nav.longitude, before.nav.longitude);
    EXPECT_LT(after.nav.height, before.nav.height);
    EXPECT_NEAR(result.position.latitude, after.nav.latitude, 1e-12);
    EXPECT_NEAR(result.position.longitude, after.nav.longitude, 1e-12);
    if (aiding == Aiding::ssbl) {
      const Vector3d moved = after.fix_bias - before.fix_bias;
      EXPECT_GT(moved.x(), 0.1);
      EXPECT_LT(moved.y(), -0.1);
      EXPECT_GT(moved.z(), 0.1);
    }
  }
}

TEST(InflightFilter, AFixAcrossTheDateLineIsNear) {
  const Settings settings = recorded_settings(Algorithm::sin_cos, Aiding::gps);
  State state = after_some_fixes(settings);
  state.ins.nav.longitude = std::numbers::pi - 1e-7;
  GeodeticPosition fix = shifted(state, 0);
  fix.longitude = -std::numbers::pi + 1e-7;
  const UpdateResult result = update(state, fix, settings);
  EXPECT_EQ(result.outcome, Outcome::ok);
  EXPECT_NEAR(result.innovation.y(), -2e-7 * 6.38e6 * std::cos(fix.latitude), 1.0);
}

// If no fixes arrive, the filter itself starts a prediction in time, so that no step is longer than
// `longest_interval`.
TEST(InflightFilter, PredictsByItselfWithoutFixes) {
  Settings settings = recorded_settings(Algorithm::sin_cos, Aiding::gps);
  settings.longest_interval = 0.995;
  const RecordedRun& from = inputs(Aiding::gps);
  State state = initial(from.start, settings);
  const Vector3d sigma = uncertainty(state).position;
  for (std::size_t i = 0; i < 1000; ++i) {
    propagate(state, from.imu[i], settings);
    ASSERT_LT(state.ins.interval.duration, settings.longest_interval);
  }
  EXPECT_GT(uncertainty(state).position.x(), 3 * sigma.x()) << "of 20 s with an unknown heading";
  EXPECT_EQ(update(state, from.fixes[19], settings).outcome, Outcome::ok);
}

// A prediction to the present must not change the estimate between fixes.
TEST(InflightFilter, TheEstimateBetweenFixesIsThePredictionsMean) {
  for (const auto [algorithm, aiding] : cases) {
    const Settings settings = recorded_settings(algorithm, aiding);
    State state = after_some_fixes(settings);
    const strapdown::NavState early = estimate(state).nav;
    if (algorithm == Algorithm::ukf) continue;  // the mean of the ukf has a second-order shift
    predict(state, settings);
    const strapdown::NavState late = estimate(state).nav;
    EXPECT_LT((early.v_eb_n - late.v_eb_n).norm(), 1e-12);
    EXPECT_LT((early.C_bn - late.C_bn).norm(), 1e-12);
  }
}

// Passes fixes to a history: fix k arrives late(k) samples late; the last fixes still arrive before the run
// ends.
template <class Late>
State run_late(const Settings& settings, Late late) {
  const RecordedRun& from = inputs(settings.aiding);
  State state = initial(from.start, settings);
  const auto history = std::make_unique<History<150>>(0);
  const auto epoch_us = [](std::size_t sample) { return static_cast<std::int64_t>(sample + 1) * 20'000; };
  constexpr std::size_t samples = 30 * samples_per_fix, last_fix = 27;
  for (std::size_t i = 0; i < samples; ++i) {
    history->propagate(state, from.imu[i], epoch_us(i), settings);
    for (std::size_t k = 0; k < last_fix; ++k) {
      const std::size_t valid = (k + 1) * samples_per_fix - 1;
      if (valid + late(k) != i) continue;
      EXPECT_EQ(history->update(state, from.fixes[k], epoch_us(valid), settings).outcome, Outcome::ok);
    }
  }
  return state;
}

TEST(InflightHistory, LateFixesGiveTheStateOfFixesInTimeBitForBit) {
  for (const auto [algorithm, aiding] : cases) {
    // With an interval of 0.495 s, each fix coincides with a prediction of the filter.
    for (const double longest : {1.5, 0.3, 0.495}) {
      Settings settings = recorded_settings(algorithm, aiding);
      settings.longest_interval = longest;
      State in_time = initial(inputs(aiding).start, settings);
      for (std::size_t i = 0; i < 30 * samples_per_fix; ++i) {
        propagate(in_time, inputs(aiding).imu[i], settings);
        if ((i + 1) % samples_per_fix == 0 && i < 27 * samples_per_fix)
          update(in_time, inputs(aiding).fixes[i / samples_per_fix], settings);
      }
      for (const std::size_t late : {0, 10, 49, 50, 75, 100}) {
        SCOPED_TRACE(late);
        EXPECT_TRUE(same_bits(run_late(settings, [&](std::size_t) { return late; }), in_time));
      }
      EXPECT_TRUE(same_bits(run_late(settings, [](std::size_t k) { return k % 2 * 40; }), in_time));
    }
  }
}

TEST(InflightHistory, AtArrivalALateFixIsTakenForAFreshOne) {
  Settings settings = recorded_settings(Algorithm::sin_cos, Aiding::ssbl);
  const State in_time = run_late(settings, [](std::size_t) { return 0; });
  settings.late_fixes = LateFixes::at_arrival;
  EXPECT_TRUE(same_bits(run_late(settings, [](std::size_t) { return 0; }), in_time));
  EXPECT_FALSE(same_bits(run_late(settings, [](std::size_t) { return 40; }), in_time));
}

TEST(InflightHistory, BetweenEpochsThePositionIsInterpolated) {
  const Settings settings = recorded_settings(Algorithm::ekf, Aiding::gps);
  const RecordedRun& from = inputs(Aiding::gps);
  State start = initial(from.start, settings);
  auto history = std::make_unique<History<16>>(0);
  for (std::size_t i = 0; i < 10; ++i)
    history->propagate(start, from.imu[i], static_cast<std::int64_t>(i + 1) * 20'000, settings);
  const auto innovation = [&](std::int64_t t_us) {
    State state = start;
    auto copy = std::make_unique<History<16>>(*history);
    return copy->update(state, from.fixes[0], t_us, settings).innovation;
  };
  const Vector3d a = innovation(160'000), b = innovation(180'000), m = innovation(165'000);
  EXPECT_GT((b - a).norm(), 0.03);
  // Between epochs the innovation is interpolated. The mean of the prediction is taken from the later epoch,
  // which changes the result by about 1e-9.
  EXPECT_LT((m - (a + 0.25 * (b - a))).norm(), 1e-6);
}

TEST(InflightHistory, RefusesWhatItCannotReach) {
  Settings settings = recorded_settings(Algorithm::sin_cos, Aiding::gps);
  settings.longest_interval = 0.1;
  const RecordedRun& from = inputs(Aiding::gps);
  State state = initial(from.start, settings);
  auto history = std::make_unique<filtering::History<HistoryModel, 150, 4>>(0);
  for (std::size_t i = 0; i < 100; ++i)
    history->propagate(state, from.imu[i], static_cast<std::int64_t>(i + 1) * 20'000, settings);
  const State before = state;
  const auto outcome = [&](std::int64_t t_us) {
    return history->update(state, from.fixes[0], t_us, settings).outcome;
  };
  EXPECT_EQ(outcome(2'000'001), Outcome::not_reached);
  // The last four predictions of 0.1 s are kept. The oldest one runs from 1.6 s to 1.7 s, so an earlier fix
  // is too old.
  EXPECT_EQ(outcome(1'580'000), Outcome::older_than_history);
  EXPECT_EQ(outcome(-1), Outcome::out_of_order);
  EXPECT_TRUE(same_bits(state, before));
  EXPECT_EQ(outcome(1'640'000), Outcome::ok);
  EXPECT_EQ(outcome(1'620'000), Outcome::out_of_order);
}

}  // namespace
}  // namespace canhil::inflight_alignment
