// What is easily got wrong in this filter; each test names the mistake it catches.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
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

using Eigen::Matrix3d;
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

// Chat <- exp(+[phi x]) Chat, phi in n axes and from the left: what dx holds is what the misalignment loses.
// A heading of 100 deg tells body from navigation axes.
TEST(Traps, CorrectionRemovesTheEstimatedError) {
  const Settings settings;
  std::mt19937_64 engine(5);
  strapdown::NavState start = flight_start();
  start.C_bn = strapdown::dcm_from_euler({0.2, 0.1, 100 * rad_per_deg});
  State state = flown(settings, 10, start);
  state.P = random_covariance<state_count>(engine) * 1e-4;
  const Ins before = state.ins;
  const UpdateResult result = update(state, before.nav.v_eb_n - Vector3d(0.3, -0.4, 0.5), settings);
  ASSERT_EQ(result.outcome, Outcome::ok);
  const Vector3d phi = result.dx.segment<3>(attitude_state);
  ASSERT_GT(phi.norm(), 1e-4);
  // Of the INS before the correction, relative to the corrected one: exactly the estimated errors.
  EXPECT_LT((strapdown::misalignment(before.nav.C_bn, state.ins.nav.C_bn) - phi).norm(), 1e-14);
  EXPECT_LT((before.nav.v_eb_n - state.ins.nav.v_eb_n - result.dx.segment<3>(velocity_state)).norm(), 1e-13);
  EXPECT_EQ(state.ins.accel_bias, before.accel_bias + result.dx.segment<3>(accel_bias_state));
  EXPECT_EQ(state.ins.gyro_bias, before.gyro_bias + result.dx.segment<3>(gyro_bias_state));
}

// The model's own signs: from each error alone the filter moves towards the truth.
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
    EXPECT_LT(strapdown::misalignment(state.ins.nav.C_bn, truth.C_bn).norm(), 0.002) << axis;
  }
}

// A known bias of the IMU must be found, not doubled.
TEST(Traps, AccelerometerBiasIsSubtracted) {
  Settings settings;
  settings.algorithm = Algorithm::kalman;
  settings.attitude_sigma_0.setConstant(1e-6);
  settings.velocity_noise_density = 1e-6;  // the default would take minutes to see 300 ug
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
    state.P = 1e-12 * Covariance::Identity();
    const UpdateResult result = update(state, state.ins.nav.v_eb_n, settings);
    const Matrix3d expected = Matrix3d::Identity() * (0.01 / (samples * 0.01));
    EXPECT_LT((result.innovation_covariance - expected).norm(), 1e-6) << samples;
  }
}

// lmax(P N'N P) takes all 12 rows of P's attitude columns, the posterior's.
TEST(Traps, BetaUsesAllRowsOfThePosterior) {
  std::mt19937_64 engine(6);
  for (const H2Case h2_case : {H2Case::one, H2Case::two, H2Case::three, H2Case::four}) {
    Settings settings;
    settings.h2_case = h2_case;
    State state = flown(settings, 10);
    state.P = random_covariance<state_count>(engine) * 1e-4;
    const Vector3d f = state.ins.interval.delta_v_n / state.ins.interval.duration;
    const Matrix3d F = strapdown::skew(f), P_phi = state.P.block<3, 3>(attitude_state, attitude_state);
    const double alpha = std::sqrt((F * P_phi * F.transpose()).trace());
    const Uncertainty u = uncertainty(h2_case, alpha);
    Covariance NtN = Covariance::Zero();
    NtN.block<3, 3>(attitude_state, attitude_state) = u.N.transpose() * u.N;
    const Covariance PNNP = state.P * NtN * state.P;
    const double beta = std::sqrt(2 * filtering::largest_eigenvalue<state_count>(PNNP) /
                                  filtering::largest_eigenvalue<3>(u.L * u.L.transpose()));
    const UpdateResult result = update(state, state.ins.nav.v_eb_n, settings);
    EXPECT_NEAR(result.alpha / alpha, 1, 1e-12);
    EXPECT_NEAR(result.beta / beta, 1, 1e-12);
  }
}

// The whole covariance step against the dense recursion: P N'N/beta in Phi, not in Q.
TEST(Traps, CovarianceStepIsTheDenseH2Recursion) {
  std::mt19937_64 engine(7);
  const Settings settings;
  State state = flown(settings, 10);
  state.P = random_covariance<state_count>(engine) * 1e-4;
  const State before = state;
  const double dt = before.ins.interval.duration;
  const UpdateResult result = update(state, state.ins.nav.v_eb_n, settings);
  const Uncertainty u = uncertainty(settings.h2_case, result.alpha);
  Eigen::Matrix<double, state_count, 3> L = Eigen::Matrix<double, state_count, 3>::Zero();
  Eigen::Matrix<double, 3, state_count> N = Eigen::Matrix<double, 3, state_count>::Zero(), H = N;
  L.topRows<3>() = u.L;
  N.middleCols<3>(attitude_state) = u.N;
  H.leftCols<3>().setIdentity();
  const Covariance A = transition_increment(before.ins.interval) / dt;
  const Covariance Q = process_noise(settings, 1).asDiagonal();
  const Covariance prior = filtering::propagate_h2<state_count, 3, 3>(before.P, A, Q, L, N, result.beta, dt);
  const Matrix3d R = Matrix3d::Identity() * (settings.velocity_noise_density / dt);
  const auto expected = filtering::update<state_count, 3>(prior, H, R, Vector3d::Zero());
  EXPECT_LT((state.P - expected.P).cwiseAbs().maxCoeff(), 1e-14);
}

// alpha = |dC| |f| or an uncapped sqrt(tr P_phi) lets the heading variance run away in cruise.
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

// Chat f is averaged over the interval: where in it the step of the specific force falls must not matter
// much, and the last sample's alone would differ by half of it.
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
  const double cross = step_early.P(velocity_state + 1, attitude_state + 2);  // dV_E of heading: g/2 dt P_phi
  ASSERT_GT(std::abs(cross), 1e-7);
  EXPECT_NEAR(step_late.P(velocity_state + 1, attitude_state + 2) / cross, 1, 1e-5);
}

}  // namespace
}  // namespace canhil::transfer_alignment
