// Properties of the transfer-alignment filter that can be tested without a reference.
#include "target/estimators/transfer_alignment/filter.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "target/estimators/filtering/cholesky.hpp"
#include "target/estimators/strapdown/attitude.hpp"
#include "tests/unit/target/estimators/flight.hpp"
#include "tests/unit/target/estimators/reference_matrix.hpp"
#include "tests/unit/target/estimators/transfer_alignment/full_run.hpp"

namespace canhil::transfer_alignment {
namespace {

using Eigen::Vector3d;

// Runs the published inputs, handing each state and result to `inspect`.
State run(const Settings& settings, const std::function<void(const State&, const UpdateResult&)>& inspect) {
  State state = initial(published_start(), settings);
  for (const Sample& sample : full_run_inputs()) {
    propagate(state, sample.imu, settings);
    if (sample.master_velocity) inspect(state, update(state, *sample.master_velocity, settings));
  }
  return state;
}
State run(const Settings& settings) {
  return run(settings, [](const State&, const UpdateResult&) {});
}

bool same(const Dense& a, const Dense& b) { return a == b; }

bool same_bits(const State& a, const State& b) {
  return same(a.P, b.P) && same(a.x, b.x) && same(a.ins.nav.C_bn, b.ins.nav.C_bn) &&
         same(a.ins.nav.v_eb_n, b.ins.nav.v_eb_n) && a.ins.nav.latitude == b.ins.nav.latitude &&
         same(a.ins.accel_bias, b.ins.accel_bias) && same(a.ins.gyro_bias, b.ins.gyro_bias);
}

TEST(TransferAlignment, H2WithoutUncertaintyIsTheKalmanFilterBitForBit) {
  Settings kalman;
  kalman.algorithm = Algorithm::kalman;
  const State expected = run(kalman);
  for (const double alpha : {0.0, 1e-200}) {
    Settings h2;
    h2.alpha_rule = AlphaRule::constant;
    h2.alpha_constant = alpha;
    const State state = run(h2, [](const State&, const UpdateResult& result) { ASSERT_EQ(result.beta, 0); });
    EXPECT_TRUE(same_bits(state, expected)) << alpha;
  }
  EXPECT_FALSE(same_bits(run(Settings{}), expected));
}

TEST(TransferAlignment, H2CasesOneAndFourAreTheSameFilter) {
  Settings one, four;
  one.h2_case = H2Case::one;
  four.h2_case = H2Case::four;
  const State a = run(one), b = run(four);
  EXPECT_LT(largest(entrywise_quotient(diagonal(a.P), diagonal(b.P)) - StateVector::Ones().eval()), 1e-12);
  EXPECT_LT(norm(Dense(a.ins.nav.v_eb_n) - b.ins.nav.v_eb_n) / norm(a.ins.nav.v_eb_n), 1e-12);
  EXPECT_LT(norm(Dense(a.ins.nav.C_bn) - b.ins.nav.C_bn), 1e-12);
}

TEST(TransferAlignment, BiasesThatAreKnownExactlyStayAsTheyAre) {
  for (const Algorithm algorithm : {Algorithm::kalman, Algorithm::robust_h2}) {
    Settings settings;
    settings.algorithm = algorithm;
    settings.accel_bias_sigma_0.setZero();
    settings.gyro_bias_sigma_0.setZero();
    const State state = run(
        settings, [](const State&, const UpdateResult& result) { ASSERT_EQ(result.outcome, Outcome::ok); });
    EXPECT_EQ(state.ins.accel_bias, Vector3d::Zero());
    EXPECT_EQ(state.ins.gyro_bias, Vector3d::Zero());
  }
}

TEST(TransferAlignment, CovarianceIsSymmetricAndPositiveDefiniteThroughout) {
  for (const Algorithm algorithm : {Algorithm::kalman, Algorithm::robust_h2}) {
    Settings settings;
    settings.algorithm = algorithm;
    double smallest = std::numeric_limits<double>::infinity();
    run(settings, [&](const State& state, const UpdateResult& result) {
      ASSERT_EQ(result.outcome, Outcome::ok);
      ASSERT_EQ(Dense(state.P), transposed(state.P));
      ASSERT_TRUE(filtering::is_positive_definite<state_count>(state.P));
      smallest = std::min(smallest, symmetric_eigenvalues(state.P)[0]);
    });
    // The variance of the gyro biases stays near (3 deg/h)^2 = 2.1e-10; in the reference, this variance falls
    // to 1.6e-10.
    EXPECT_GT(smallest, 1.4e-10);
  }
}

TEST(TransferAlignment, VanishingAttitudeCovarianceGivesNoNan) {
  for (const double sigma : {0.0, 1e-160, 1e-80, 1e-20}) {
    Settings settings;
    settings.attitude_sigma_0.setConstant(sigma);
    settings.gyro_noise_density = 0;
    settings.gyro_bias_sigma_0.setConstant(1e-12);
    int updates = 0;
    const State state = run(settings, [&](const State&, const UpdateResult& result) {
      if (result.outcome == Outcome::ok) ++updates;
    });
    EXPECT_TRUE(state.P.allFinite() && state.ins.nav.C_bn.allFinite() && state.ins.nav.v_eb_n.allFinite())
        << sigma;
    // With a variance of 0, P is a valid covariance only after the gyro bias has increased this variance.
    if (sigma > 1e-100) {
      EXPECT_EQ(updates, 200) << sigma;
    }
  }
}

TEST(TransferAlignment, TwoMechanisationsAgreeOnTheFullRun) {
  Settings reference, two_sample;
  reference.algorithm = two_sample.algorithm = Algorithm::kalman;
  reference.mechanization = strapdown::Mechanization::reference;
  two_sample.mechanization = strapdown::Mechanization::two_sample;
  std::vector<strapdown::NavState> expected;
  run(reference, [&](const State& state, const UpdateResult&) { expected.push_back(state.ins.nav); });
  std::size_t k = 0;
  run(two_sample, [&](const State& state, const UpdateResult&) {
    EXPECT_LT(norm(Dense(state.ins.nav.v_eb_n) - expected[k].v_eb_n), 1e-3) << k;
    EXPECT_LT(norm(strapdown::misalignment(state.ins.nav.C_bn, expected[k].C_bn)), 1e-5) << k;
    EXPECT_NE(Dense(state.ins.nav.C_bn), Dense(expected[k].C_bn)) << "the setting has no effect";
    ++k;
  });
  EXPECT_EQ(k, 200);
}

// For small errors the model is linear: open and closed loop must give the same estimate.
TEST(TransferAlignment, OpenLoopEstimatesWhatTheClosedLoopDoesForSmallErrors) {
  Settings closed, open;
  closed.algorithm = open.algorithm = Algorithm::kalman;
  open.loop = Loop::open;
  const auto start = with_errors(flight_start(), Vector3d(0.01, -0.02, 0.01), Vector3d(1e-4, -1e-4, 2e-4));
  State a = initial(start, closed), b = initial(start, open);
  strapdown::NavState truth = flight_start();
  for (int k = 0; k < 2000; ++k) {
    const double dt = 0.01, t = k * dt;
    const auto imu = flight_increment(truth, t, dt);
    truth = flight_next(truth, t, dt);
    propagate(a, imu, closed);
    propagate(b, imu, open);
    if (k % 10 != 9) continue;
    ASSERT_EQ(update(a, truth.v_eb_n, closed).outcome, Outcome::ok);
    ASSERT_EQ(update(b, truth.v_eb_n, open).outcome, Outcome::ok);
  }
  EXPECT_EQ(largest(a.x), 0);
  EXPECT_GT(norm(Dense(b.x).block(attitude_state, 0, 3, 1)), 1e-4) << "the open loop leaves the INS alone";
  const Ins from_a = estimate(a), from_b = estimate(b);
  // The differences are of second order. With |phi| = 2e-4, the attitudes differ by about |phi|^2, and the
  // velocities by about 20 s times g |phi|^2.
  EXPECT_LT(norm(strapdown::misalignment(from_a.nav.C_bn, from_b.nav.C_bn)), 2e-7);
  EXPECT_LT(norm(Dense(from_a.nav.v_eb_n) - from_b.nav.v_eb_n), 1e-5);
}

TEST(TransferAlignment, FadingGrowsTheSigmasAtItsRate) {
  Settings plain, fading;
  plain.algorithm = fading.algorithm = Algorithm::kalman;
  fading.fading_per_s = 0.1;
  const auto imu = flight_increment(flight_start(), 0, 0.01);
  State a = initial(flight_start(), plain), b = a;
  for (int k = 0; k < 10; ++k) propagate(a, imu, plain), propagate(b, imu, fading);
  update(a, flight_start().v_eb_n, plain);
  update(b, flight_start().v_eb_n, fading);
  // Gyro biases are not observable yet: fading has increased their sigma by exp(0.1 * 0.1).
  EXPECT_NEAR(std::sqrt(b.P(11, 11) / a.P(11, 11)), std::exp(0.01), 1e-9);
}

TEST(TransferAlignment, RefusedUpdatesLeaveTheStateAlone) {
  const Settings settings;
  State state = initial(published_start(), settings);
  EXPECT_EQ(update(state, Vector3d::Zero(), settings).outcome, Outcome::no_interval);

  propagate(state, flight_increment(flight_start(), 0, 0.01), settings);
  const State before = state;
  const Vector3d nan = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(update(state, nan, settings).outcome, Outcome::non_finite);
  EXPECT_TRUE(same_bits(state, before));
  EXPECT_EQ(state.ins.interval.duration, before.ins.interval.duration);

  State broken = before;
  broken.P(0, 0) = -10;
  EXPECT_EQ(update(broken, Vector3d::Zero(), settings).outcome, Outcome::not_positive_definite);
  EXPECT_EQ(broken.P(0, 0), -10);
  EXPECT_EQ(Dense(broken.ins.nav.v_eb_n), Dense(before.ins.nav.v_eb_n));

  EXPECT_EQ(update(state, flight_start().v_eb_n, settings).outcome, Outcome::ok) << "and the next one serves";
}

}  // namespace
}  // namespace canhil::transfer_alignment
