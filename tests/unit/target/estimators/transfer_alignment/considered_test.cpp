// Errors that the filter considers, compared with what such errors do, and with a dense reference.
#include "target/estimators/transfer_alignment/considered.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/transfer_alignment/filter.hpp"
#include "tests/unit/target/estimators/flight.hpp"
#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::transfer_alignment {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Settings invariant() {
  Settings settings;
  settings.algorithm = Algorithm::kalman;
  settings.loop = Loop::invariant;
  settings.velocity_noise_density = 2.5e-4;
  settings.gyro_noise_density *= 0.1;
  return settings;
}

// The errors of an IMU and its place that a test gives to the slave.
struct Wrong {
  Matrix3d accel = Matrix3d::Zero(), gyro = Matrix3d::Zero();
  Vector3d lever_arm = Vector3d::Zero();
  Vector3d master = Vector3d::Zero();  // [m/s]
};

// 10 s of turns and accelerations about and along all axes. The INS of the truth has no errors.
State fly(const Settings& settings, const Wrong& wrong, strapdown::NavState& truth) {
  truth = flight_start();
  State state = initial(truth, settings);
  strapdown::ImuIncrement previous;
  for (int k = 0; k < 1000; ++k) {
    const double t = 0.01 * k;
    const Vector3d rate(0.3 * std::sin(t), 0.2 * std::cos(2 * t), 0.25 * std::sin(0.5 * t)),
        force(3 * std::cos(t), 2 * std::sin(1.5 * t), -9.8);
    const strapdown::ImuIncrement exact{.delta_theta = 0.01 * rate, .delta_v = 0.01 * force, .dt = 0.01};
    truth = strapdown::mechanize(settings.mechanization, truth, previous, exact).nav;
    previous = exact;
    propagate(state,
              {.delta_theta = exact.delta_theta + wrong.gyro * exact.delta_theta,
               .delta_v = exact.delta_v + wrong.accel * exact.delta_v,
               .dt = 0.01},
              settings);
    if (k % 2 == 1) {
      const Vector3d of_arm = truth.C_bn * rate.cross(wrong.lever_arm);
      EXPECT_EQ(update(state, truth.v_eb_n + wrong.master - of_arm, settings).outcome, Outcome::ok);
    }
  }
  return state;
}

StateVector error(const State& state, const strapdown::NavState& truth) {
  StateVector x;
  const Matrix3d turned = state.ins.nav.C_bn * truth.C_bn.transpose();  // exp(-[phi x])
  x << state.ins.nav.v_eb_n - truth.v_eb_n,
      Vector3d(turned(1, 2) - turned(2, 1), turned(2, 0) - turned(0, 2), turned(0, 1) - turned(1, 0)) / 2,
      -state.ins.accel_bias, -state.ins.gyro_bias;
  return x;
}

// The lever arm's part of V_slave - V_master is C (omega x l), so the slave is l away from the master. The
// estimates of the biases are what is subtracted from the IMU: an error of +b has the estimate -b here.
TEST(Considered, SensitivityIsWhatAnErrorDoesToTheFilter) {
  static constexpr double q = 1e-3;
  const auto compare = [](const Settings& settings, const Wrong& wrong, int column) {
    SCOPED_TRACE(column);
    strapdown::NavState truth;
    const State state = fly(settings, wrong, truth);
    const StateVector seen = error(state, truth), expected = q * state.S.col(column);
    EXPECT_GT(expected.norm(), 0);
    EXPECT_LT((seen - expected).head<6>().norm(), 0.05 * expected.head<6>().norm());
    EXPECT_LT((seen - expected).tail<6>().norm(), 0.1 * expected.tail<6>().norm());
  };
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Settings settings = invariant();
      settings.accel_scale_factor_sigma = settings.accel_misalignment_sigma = 0.1;
      Wrong wrong;
      wrong.accel(i, j) = 0.1 * q;
      compare(settings, wrong, accel_matrix + 3 * j + i);
      settings = invariant();
      settings.gyro_scale_factor_sigma = settings.gyro_misalignment_sigma = 0.1;
      wrong = {};
      wrong.gyro(i, j) = 0.1 * q;
      compare(settings, wrong, gyro_matrix + 3 * j + i);
    }
  for (int i = 0; i < 3; ++i) {
    Settings settings = invariant();
    settings.lever_arm_sigma = 0.5;
    Wrong wrong;
    wrong.lever_arm(i) = 0.5 * q;
    compare(settings, wrong, lever_arm + i);
    settings = invariant();
    settings.velocity_correlated_sigma = 0.5;
    settings.velocity_correlation_s = 1e9;
    wrong = {};
    wrong.master(i) = 0.5 * q;
    compare(settings, wrong, master_error + i);
  }
}

// The Schmidt filter as a Kalman filter of states and considered errors whose gain for the latter is 0.
TEST(Considered, UpdateIsThatOfTheWholeCovarianceWithoutAGainForTheConsideredErrors) {
  constexpr int n = state_count + considered_count;
  std::mt19937_64 engine(45);
  const Dense S = 0.2 * random_dense(state_count, considered_count, engine);
  Dense whole = identity(n);
  whole.set(0, 0, Dense(random_covariance<state_count>(engine)) + S * transposed(S));
  whole.set(0, state_count, S).set(state_count, 0, transposed(S));
  const Dense Hq = random_dense(3, 6, engine);
  const Dense H = Dense(3, n).set(0, velocity_state, identity(3)).set(0, n - 6, Hq);
  const Dense R = 0.3 * identity(3), innovation = random_dense(3, 1, engine);
  const Dense W = H * whole * transposed(H) + R;
  const Dense K = Dense(n, 3).set(0, 0, (whole * transposed(H) * inverse(W)).block(0, 0, state_count, 3));
  const Dense kept = identity(n) - K * H;
  const Dense expected = kept * whole * transposed(kept) + K * R * transposed(K);

  const Covariance P = whole.block(0, 0, state_count, state_count).fixed<state_count, state_count>();
  Sensitivity sensitivity = S.fixed<state_count, considered_count>();
  const DifferenceOf by_q = Hq.fixed<3, 6>();
  const auto c = update_considered(P, sensitivity, by_q, R.fixed<3, 3>(), innovation.fixed<3, 1>());
  ASSERT_TRUE(c.positive_definite);
  EXPECT_LT(largest_difference(c.S, W), 1e-12);
  EXPECT_LT(largest_difference(c.P, expected.block(0, 0, state_count, state_count)), 1e-10);
  correct_considered(sensitivity, c.K, by_q);
  EXPECT_LT(largest_difference(sensitivity, expected.block(0, state_count, state_count, considered_count)),
            1e-10);
  const Vector3d share = considered_share(S.fixed<state_count, considered_count>(), by_q, c.S);
  const Dense seen =
      Dense(3, considered_count)
          .set(0, 0, S.block(velocity_state, 0, 3, considered_count))
          .set(0, considered_count - 6, S.block(velocity_state, considered_count - 6, 3, 6) + Hq);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(share(i), dot(seen.row(i), seen.row(i)) / W(i, i), 1e-12);
}

TEST(Considered, NothingStatedIsTheFilterWithoutIt) {
  EXPECT_FALSE(considers(invariant()));
  strapdown::NavState truth;
  EXPECT_TRUE(fly(invariant(), {}, truth).S.isZero(0));
}

// The first velocity after an outage has the noise of any other. A wait that comes twice is the master's
// period.
TEST(Outage, DoesNotMakeTheNextVelocityCountMore) {
  const Settings settings = invariant();
  const auto noise_after = [&](std::initializer_list<int> waits) {  // in samples
    State state = initial(flight_start(), settings);
    strapdown::NavState truth = flight_start();
    int k = 0;
    Matrix3d R = Matrix3d::Zero();
    for (const int wait : waits) {
      for (const int end = k + wait; k < end; ++k) {
        propagate(state, flight_increment(truth, k * 0.01, 0.01), settings);
        truth = flight_next(truth, k * 0.01, 0.01);
        if (prediction_is_due(state, settings)) predict(state, settings);
      }
      State before = state;
      if (before.ins.interval.duration > 0) predict(before, settings);
      const UpdateResult result = update(state, truth.v_eb_n, settings);
      EXPECT_EQ(result.outcome, Outcome::ok);
      R = result.innovation_covariance - before.P.topLeftCorner<3, 3>();
    }
    return R(0, 0);
  };
  const double usual = settings.velocity_noise_density / 0.1;
  EXPECT_NEAR(noise_after({10, 10}), usual, 1e-9);
  EXPECT_NEAR(noise_after({10, 10, 800}), usual, 1e-9) << "an outage of 8 s";
  EXPECT_NEAR(noise_after({800}), usual, 1e-9) << "an outage from the start on";
  EXPECT_NEAR(noise_after({10, 20, 10}), usual, 1e-9) << "a lost velocity";
  EXPECT_NEAR(noise_after({5, 5}), 2 * usual, 1e-9) << "20 Hz";
  EXPECT_NEAR(noise_after({50, 50}), usual / 5, 1e-9) << "2 Hz";
}

// One step over an outage would be of the first order in a turn of a radian.
TEST(Outage, IsPredictedInShortSteps) {
  const Settings settings = invariant();
  EXPECT_FALSE(prediction_is_due(initial(flight_start(), settings), settings));
  State coarse = initial(flight_start(), settings), fine = coarse;
  for (int k = 0; k < 1000; ++k) {
    const strapdown::ImuIncrement imu{
        .delta_theta = {0, 0, 1e-3}, .delta_v = {0.02, 0.01, -0.098}, .dt = 0.01};
    for (State* state : {&coarse, &fine}) propagate(*state, imu, settings);
    if (prediction_is_due(coarse, settings)) predict(coarse, settings);
    predict(fine, settings);
  }
  predict(coarse, settings);
  for (int i = 0; i < state_count; ++i) EXPECT_NEAR(std::sqrt(coarse.P(i, i) / fine.P(i, i)), 1, 0.02) << i;
  Settings published = settings;
  published.loop = Loop::published;
  State state = initial(flight_start(), published);
  for (int k = 0; k < 100; ++k) propagate(state, flight_increment(flight_start(), 0, 0.01), published);
  EXPECT_FALSE(prediction_is_due(state, published)) << "the published filter makes one step";
}

TEST(Bridge, ItsVarianceEntersTheCovariance) {
  const Settings settings = invariant();
  State measured = initial(flight_start(), settings), bridged = measured;
  strapdown::ImuIncrement imu = flight_increment(flight_start(), 0, 0.01);
  propagate(measured, imu, settings);
  imu.delta_theta_variance = {1e-6, 2e-6, 3e-6};
  imu.delta_v_variance = {1e-4, 2e-4, 3e-4};
  propagate(bridged, imu, settings);
  predict(measured, settings);
  predict(bridged, settings);
  const StateVector added = bridged.P.diagonal() - measured.P.diagonal();
  EXPECT_LT((added.segment<3>(attitude_state) - imu.delta_theta_variance).norm(), 1e-8);
  EXPECT_LT((added.segment<3>(velocity_state) - imu.delta_v_variance).norm(), 1e-6);
}

}  // namespace
}  // namespace canhil::transfer_alignment
