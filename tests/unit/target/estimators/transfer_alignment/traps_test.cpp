// Frequent mistakes in a filter for transfer alignment; each test detects one of them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "target/estimators/filtering/robust_h2.hpp"
#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/transfer_alignment/filter.hpp"
#include "target/estimators/transfer_alignment/uncertainty.hpp"
#include "tests/unit/target/estimators/flight.hpp"
#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::transfer_alignment {
namespace {

using Eigen::Vector3d;

// A slave that has flown `samples` error-free increments.
State flown(const Settings& settings, int samples, const strapdown::NavState& start = published_start()) {
  State state = initial(start, settings);
  strapdown::NavState truth = flight_start();
  for (int k = 0; k < samples; ++k) {
    propagate(state, flight_increment(truth, k * 0.01, 0.01), settings);
    truth = flight_next(truth, k * 0.01, 0.01);
  }
  return state;
}

Dense three(const StateVector& x, int first) { return Dense(x).block(first, 0, 3, 1); }

// A random covariance with standard deviations of the order of 0.01.
Covariance small_covariance(std::mt19937_64& engine) {
  return (1e-4 * random_covariance_dense(state_count, engine)).fixed<state_count, state_count>();
}

// The correction Chat <- exp(+[phi x]) Chat has phi in n axes and multiplies from the left. It must reduce
// the misalignment by exactly the attitude part of dx. At a heading of 100 deg, a filter that confuses body
// and navigation axes fails this test.
TEST(Traps, CorrectionRemovesTheEstimatedError) {
  const Settings settings;
  std::mt19937_64 engine(5);
  strapdown::NavState start = flight_start();
  start.C_bn = strapdown::dcm_from_euler({0.2, 0.1, 100 * rad_per_deg});
  State state = flown(settings, 10, start);
  state.P = small_covariance(engine);
  const Ins before = state.ins;
  const UpdateResult result = update(state, before.nav.v_eb_n - Vector3d(0.3, -0.4, 0.5), settings);
  ASSERT_EQ(result.outcome, Outcome::ok);
  const Dense phi = three(result.dx, attitude_state);
  ASSERT_GT(norm(phi), 1e-4);
  // The INS before the correction, relative to the corrected INS, must differ by exactly the estimated
  // errors.
  EXPECT_LT(norm(Dense(strapdown::misalignment(before.nav.C_bn, state.ins.nav.C_bn)) - phi), 1e-14);
  EXPECT_LT(norm(Dense(before.nav.v_eb_n) - state.ins.nav.v_eb_n - three(result.dx, velocity_state)), 1e-13);
  EXPECT_EQ(Dense(state.ins.accel_bias), Dense(before.accel_bias) + three(result.dx, accel_bias_state));
  EXPECT_EQ(Dense(state.ins.gyro_bias), Dense(before.gyro_bias) + three(result.dx, gyro_bias_state));
}

// The signs of the model: for each single error, the filter moves towards the truth.
TEST(Traps, EachErrorIsDrivenTowardsZero) {
  Settings settings;
  settings.algorithm = Algorithm::kalman;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d phi = 0.02 * Vector3d::Unit(axis);
    State state = initial(with_errors(flight_start(), Vector3d::Zero(), phi), settings);
    strapdown::NavState truth = flight_start();
    for (int k = 0; k < 2000; ++k) {
      const double dt = 0.01, t = k * dt;
      propagate(state, flight_increment(truth, t, dt), settings);
      truth = flight_next(truth, t, dt);
      if (k % 10 == 9) update(state, truth.v_eb_n, settings);
    }
    EXPECT_LT(norm(strapdown::misalignment(state.ins.nav.C_bn, truth.C_bn)), 0.002) << axis;
  }
}

// A known bias of the IMU must be found, not doubled.
TEST(Traps, AccelerometerBiasIsSubtracted) {
  Settings settings;
  settings.algorithm = Algorithm::kalman;
  settings.attitude_sigma_0.setConstant(1e-6);
  settings.velocity_noise_density = 1e-6;  // with the default, 300 ug would be observable only after minutes
  const Vector3d bias(0, 0, 0.003);
  State state = initial(flight_start(), settings);
  strapdown::NavState truth = flight_start();
  for (int k = 0; k < 1000; ++k) {
    auto imu = flight_increment(truth, k * 0.01, 0.01);
    imu.delta_v += bias * imu.dt;
    propagate(state, imu, settings);
    truth = flight_next(truth, k * 0.01, 0.01);
    if (k % 10 == 9) update(state, truth.v_eb_n, settings);
  }
  EXPECT_NEAR(state.ins.accel_bias.z(), bias.z(), 3e-4);
}

// R is a density: R_k = R/dt.
TEST(Traps, MeasurementNoiseIsADensity) {
  Settings settings;
  settings.algorithm = Algorithm::kalman;
  for (const int samples : {5, 10, 30}) {
    State state = flown(settings, samples);
    state.P = (1e-12 * identity(state_count)).fixed<state_count, state_count>();
    const UpdateResult result = update(state, state.ins.nav.v_eb_n, settings);
    const Dense expected = 0.01 / (samples * 0.01) * identity(3);
    EXPECT_LT(norm(result.innovation_covariance - expected), 1e-6) << samples;
  }
}

// lmax(P N'N P) must use all 12 rows of the attitude columns of the posterior P.
TEST(Traps, BetaUsesAllRowsOfThePosterior) {
  std::mt19937_64 engine(6);
  for (const H2Case h2_case : {H2Case::one, H2Case::two, H2Case::three, H2Case::four}) {
    Settings settings;
    settings.h2_case = h2_case;
    State state = flown(settings, 10);
    state.P = small_covariance(engine);
    const Vector3d f = state.ins.interval.delta_v_n / state.ins.interval.duration;
    const Dense F = strapdown::skew(f), P = state.P;
    const Dense F_P_Ft = F * P.block(attitude_state, attitude_state, 3, 3) * transposed(F);
    const double alpha = std::sqrt(F_P_Ft(0, 0) + F_P_Ft(1, 1) + F_P_Ft(2, 2));
    const Uncertainty u = uncertainty(h2_case, alpha);
    Dense NtN(state_count, state_count);
    NtN.set(attitude_state, attitude_state, transposed(u.N) * u.N);
    const double beta = std::sqrt(2 * symmetric_eigenvalues(P * NtN * P).back() /
                                  symmetric_eigenvalues(Dense(u.L) * transposed(u.L)).back());
    const UpdateResult result = update(state, state.ins.nav.v_eb_n, settings);
    EXPECT_NEAR(result.alpha / alpha, 1, 1e-12);
    EXPECT_NEAR(result.beta / beta, 1, 1e-12);
  }
}

// Compares the whole covariance step with the dense recursion, in which P N'N/beta is in Phi, not in Q.
TEST(Traps, CovarianceStepIsTheDenseH2Recursion) {
  std::mt19937_64 engine(7);
  const Settings settings;
  State state = flown(settings, 10);
  state.P = small_covariance(engine);
  const State before = state;
  const double dt = before.ins.interval.duration;
  const UpdateResult result = update(state, state.ins.nav.v_eb_n, settings);
  const Uncertainty u = uncertainty(settings.h2_case, result.alpha);
  const auto L = Dense(state_count, 3).set(0, 0, u.L).fixed<state_count, 3>();
  const auto N = Dense(3, state_count).set(0, attitude_state, u.N).fixed<3, state_count>();
  const auto H = Dense(3, state_count).set(0, 0, identity(3)).fixed<3, state_count>();
  const auto A = (Dense(transition_increment(before.ins.interval)) / dt).fixed<state_count, state_count>();
  const auto Q = diagonal_matrix(process_noise(settings, 1)).fixed<state_count, state_count>();
  const Covariance prior = filtering::propagate_h2<state_count, 3, 3>(before.P, A, Q, L, N, result.beta, dt);
  const auto R = (settings.velocity_noise_density / dt * identity(3)).fixed<3, 3>();
  const auto expected = filtering::update<state_count, 3>(prior, H, R, Vector3d::Zero());
  EXPECT_LT(largest_difference(state.P, expected.P), 1e-14);
}

// With alpha = |dC| |f|, or with sqrt(tr P_phi) without a cap, the heading variance would diverge in the
// cruise.
TEST(Traps, AlphaIsCapped) {
  Settings settings;
  State state = flown(settings, 10);
  state.P.diagonal().segment<3>(attitude_state).setConstant(10);
  const double f = (state.ins.interval.delta_v_n / state.ins.interval.duration).norm();
  const UpdateResult result = update(state, state.ins.nav.v_eb_n, settings);
  EXPECT_NEAR(result.alpha, 2 * std::sin(3 * std::sqrt(3.0) * rad_per_deg / 2) * f, 1e-12);
}

TEST(Traps, AlphaOfAHeadingErrorVanishesInLevelFlight) {
  Settings settings;
  Covariance P = Covariance::Zero();
  P(attitude_state + 2, attitude_state + 2) = 0.01;
  EXPECT_NEAR(uncertainty_size(settings, P, Vector3d(0, 0, -9.8)), 0, 1e-12);
  EXPECT_NEAR(uncertainty_size(settings, P, Vector3d(5, 0, -9.8)), 0.5, 1e-12);
}

// Chat f is averaged over the interval, so it hardly matters when, within the interval, the specific force
// changes in a step. If only the last sample's Chat f were used, the result would differ by half.
TEST(Traps, SpecificForceIsAveragedOverTheInterval) {
  Settings settings;
  settings.algorithm = Algorithm::kalman;
  State step_late = initial(flight_start(), settings), step_early = step_late;
  const auto calm = flight_increment(flight_start(), 0, 0.01),
             accelerated = flight_increment(flight_start(), 11, 0.01);
  for (int k = 0; k < 10; ++k) {
    propagate(step_late, k < 5 ? calm : accelerated, settings);
    propagate(step_early, k < 5 ? accelerated : calm, settings);
  }
  const Vector3d mean = step_late.ins.interval.delta_v_n / step_late.ins.interval.duration;
  EXPECT_NEAR(mean.x(), flight_acceleration / 2, 1e-4);
  update(step_late, flight_start().v_eb_n, settings);
  update(step_early, flight_start().v_eb_n, settings);
  const double cross = step_early.P(velocity_state + 1, attitude_state + 2);  // dV_E by heading: g/2 dt P_phi
  ASSERT_GT(std::abs(cross), 1e-7);
  EXPECT_NEAR(step_late.P(velocity_state + 1, attitude_state + 2) / cross, 1, 1e-5);
}

}  // namespace
}  // namespace canhil::transfer_alignment
