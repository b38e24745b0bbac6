// Properties of a complete step: exactness, signs, two planes under roll.
#include "target/estimators/los_rate/filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tests/unit/target/estimators/los_rate/engagement.hpp"

namespace canhil::los_rate {
namespace {

constexpr std::array algorithms{Algorithm::switched_table, Algorithm::combined, Algorithm::kalman,
                                Algorithm::low_pass};

// The filter starts at the truth, without noise. An exact prediction then needs no correction; Euler steps
// would need one.
TEST(LosRate, PredictionIsExactForConstantClosingSpeed) {
  EngagementSetup setup = setup_of(Algorithm::kalman);
  setup.target = {0, 40};
  setup.manoeuvre_s = 100;
  setup.roll_rate = 0;
  Engagement engagement(setup);
  engagement.next();
  State state = initial();
  state.error = engagement.truth().error;
  state.rate = engagement.truth().rate;
  state.acceleration = setup.target;
  while (!engagement.over()) {
    const Measurement m = engagement.next();
    const double vc = m.range.closing_speed;
    predict(state, {m.range.range, vc}, m.dt, {m.antenna_increment.yaw, m.antenna_increment.pitch},
            {m.missile_acceleration.yaw, -m.missile_acceleration.pitch}, m.roll_increment);
    ASSERT_LT(std::abs(state.rate - engagement.truth().rate), 1e-9) << engagement.truth().range;
    ASSERT_LT(std::abs(state.error - engagement.truth().error), 1e-9);
  }
}

TEST(LosRate, ConvergesToTheTruthInBothPlanesWithTheirSigns) {
  for (const Algorithm algorithm : algorithms) {
    EngagementSetup setup = setup_of(algorithm);
    setup.target = {30, -20};  // to the right, and -j a_z: 20 m/s^2 down
    setup.manoeuvre_s = 2;
    setup.guidance = 0;
    setup.settings.low_pass_bandwidth = 12;
    int judged = 0;
    run(setup, [&](const Truth& truth, const State& state, const UpdateResult& result) {
      if (truth.time_to_go > 0.7 || truth.time_to_go < 0.5) return;
      const Estimate x = estimate(state);
      EXPECT_EQ(result.outcome, Outcome::updated);
      // The classical filter lags behind a LOS rate that grows at the relative rate 2 vc/r.
      const double bar = algorithm == Algorithm::low_pass ? 0.6 : 0.03;
      EXPECT_NEAR(x.rate.yaw / truth.rate.real(), 1, bar);
      EXPECT_NEAR(x.rate.pitch / truth.rate.imag(), 1, bar);
      if (algorithm == Algorithm::low_pass) return;
      EXPECT_NEAR(x.acceleration.yaw, 30, 2);
      EXPECT_NEAR(x.acceleration.pitch, 20, 2);
      ++judged;
    });
    if (algorithm != Algorithm::low_pass) {
      EXPECT_GT(judged, 30);
    }
  }
}

// The estimate in a rolling antenna must equal the rotated estimate in an antenna that does not roll.
TEST(TwoPlanes, RollOnlyTurnsTheEstimate) {
  for (const Algorithm algorithm : algorithms) {
    EngagementSetup level = setup_of(algorithm);
    level.target = {40, 10};
    level.noisy = false;
    EngagementSetup rolling = level;
    rolling.roll_rate = 7;
    std::vector<State> expected;
    std::vector<double> nis;
    run(level, [&](const Truth&, const State& state, const UpdateResult& result) {
      expected.push_back(state);
      nis.push_back(result.nis);
    });
    std::size_t k = 0;
    run(rolling, [&](const Truth&, const State& state, const UpdateResult& result) {
      const Plane turn = std::polar(1.0, 7 * 0.005 * static_cast<double>(k + 1));
      ASSERT_LT(std::abs(state.error - turn * expected[k].error), 1e-11) << k;
      ASSERT_LT(std::abs(state.rate - turn * expected[k].rate), 1e-9) << k;
      ASSERT_NEAR(result.nis, nis[k], 1e-7 * (1 + nis[k]));
      ++k;
    });
    EXPECT_EQ(k, expected.size());
  }
}

// Without the roll term the error is 30 instead of 0.4 mrad/s.
TEST(TwoPlanes, WithoutTheRollTermTheEstimateIsLost) {
  EngagementSetup setup = setup_of(Algorithm::kalman);
  setup.roll_rate = 3;
  setup.first_rate = {0.02, 0};
  setup.guidance = 0;
  const Design design = make_design(setup.settings);
  Engagement engagement(setup);
  State with = initial(), without = initial();
  double sum_with = 0, sum_without = 0;
  while (!engagement.over()) {
    Measurement m = engagement.next();
    step(with, m, design);
    m.roll_increment = 0;
    step(without, m, design);
    const Truth& truth = engagement.truth();
    if (truth.time_to_go > 3 || truth.time_to_go < 0.2) continue;
    sum_with += std::norm(with.rate - truth.rate);
    sum_without += std::norm(without.rate - truth.rate);
  }
  EXPECT_GT(sum_without, 1000 * sum_with);
}

// The 6-state Kalman filter of section 5 of the notes, with the roll in its transition. With equal noises its
// covariance must have two equal blocks, and its estimate must equal the estimate of the tested filter.
TEST(TwoPlanes, EqualsTheSixStateKalmanFilterUnderRoll) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  EngagementSetup setup = setup_of(Algorithm::kalman);
  setup.roll_rate = 7;
  setup.noisy = true;
  setup.target = {40, 0};
  const Design design = make_design(setup.settings);
  Engagement engagement(setup);
  State state = initial();
  Vector6 x = Vector6::Zero();  // e_z, w_z, a_y; e_y, w_y, -a_z
  Matrix6 P = Matrix6::Zero();
  bool started = false;
  while (!engagement.over()) {
    const Measurement m = engagement.next();
    const UpdateResult result = step(state, m, design);
    if (result.blind) break;
    const Geometry at = result.used;
    const double R = sample_variance(setup.settings.noise.pitch, at.range);
    if (!started) {
      x << m.error.yaw, 0, 0, m.error.pitch, 0, 0;
      P.diagonal() << R, 0.0025, 1600, R, 0.0025, 1600;
      started = true;
      continue;
    }
    const double c = std::cos(m.roll_increment), s = std::sin(m.roll_increment);
    const double ch = std::cos(m.roll_increment / 2), sh = std::sin(m.roll_increment / 2);
    const Transition phi = transition(at, m.dt);
    Eigen::Matrix3d F;
    F << 1, phi.ew, phi.ea, 0, phi.ww, phi.wa, 0, 0, 1;
    Matrix6 Phi;
    Phi << c * F, -s * F, s * F, c * F;
    const Eigen::Vector3d column(phi.ea, phi.wa, 0), first(1, 0, 0);
    const double am_y = m.missile_acceleration.yaw, am_z = -m.missile_acceleration.pitch;
    Vector6 u;
    u << -column * (ch * am_y - sh * am_z) -
             first * (ch * m.antenna_increment.yaw - sh * m.antenna_increment.pitch),
        -column * (sh * am_y + ch * am_z) -
            first * (sh * m.antenna_increment.yaw + ch * m.antenna_increment.pitch);
    const Covariance Qd = predicted({}, at, m.dt, setup.settings.jerk_density);
    Eigen::Matrix3d Q;
    Q << Qd.ee, Qd.ew, Qd.ea, Qd.ew, Qd.ww, Qd.wa, Qd.ea, Qd.wa, Qd.aa;
    Matrix6 Q6 = Matrix6::Zero();
    Q6.topLeftCorner<3, 3>() = Q6.bottomRightCorner<3, 3>() = Q;
    x = Phi * x;
    // The input acts during the rotation. The last columns of Phi would rotate the input by the whole angle,
    // but on average the input is rotated by half of the angle.
    x += u;
    P = Phi * P * Phi.transpose() + Q6;
    Eigen::Matrix<double, 2, 6> H = Eigen::Matrix<double, 2, 6>::Zero();
    H(0, 0) = H(1, 3) = 1;
    const Eigen::Matrix2d S = H * P * H.transpose() + R * Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 6, 2> K = P * H.transpose() * S.inverse();
    const Eigen::Vector2d innovation(m.error.yaw - x(0), m.error.pitch - x(3));
    x += K * innovation;
    P = (Matrix6::Identity() - K * H) * P;
    const Estimate estimated = estimate(state);
    ASSERT_NEAR(estimated.rate.yaw, x(1), 1e-9);
    ASSERT_NEAR(estimated.rate.pitch, x(4), 1e-9);
    ASSERT_NEAR(estimated.acceleration.pitch, -x(5), 1e-6);
    ASSERT_NEAR(result.sigma.pitch.rate, std::sqrt(P(1, 1)), 1e-9);
    ASSERT_LT((P.block<3, 3>(0, 3).cwiseAbs().maxCoeff()), 1e-9 * P(2, 2)) << "planes are not correlated";
    ASSERT_NEAR(result.nis / innovation.dot(S.inverse() * innovation), 1, 1e-6);
  }
}

// With unequal noises, pitch and yaw have separate gains. Nearly equal noises must give the same estimate; a
// larger noise in yaw must increase the sigma of yaw only.
TEST(TwoPlanes, UnequalNoisesTakeTwoGainSets) {
  for (const Algorithm algorithm : algorithms) {
    EngagementSetup equal = setup_of(algorithm);
    equal.noisy = true;
    EngagementSetup close = equal, apart = equal;
    close.settings.noise.yaw.glint *= 1 + 1e-12;
    apart.settings.noise.yaw = {.thermal = 3e-10, .glint = 1.5, .constant = 0};
    ASSERT_TRUE(make_design(equal.settings).equal_noise);
    ASSERT_FALSE(make_design(close.settings).equal_noise);
    std::vector<Plane> one;
    std::vector<Sigma> sigma;
    run(equal, [&](const Truth&, const State& state, const UpdateResult& result) {
      one.push_back(state.rate);
      sigma.push_back(result.sigma.pitch);
      EXPECT_EQ(result.sigma.pitch.rate, result.sigma.yaw.rate);
    });
    std::size_t k = 0;
    run(close, [&](const Truth&, const State& state, const UpdateResult&) {
      ASSERT_LT(std::abs(state.rate - one[k++]), 1e-9);
    });
    k = 0;
    double larger = 1e9;
    run(apart, [&](const Truth& truth, const State&, const UpdateResult& result) {
      if (truth.time_to_go < 0.3) return;  // in yaw the noise exceeds the field of view
      EXPECT_NEAR(result.sigma.pitch.rate, sigma[k++].rate, 1e-15);
      if (truth.time_to_go < 3) larger = std::min(larger, result.sigma.yaw.rate / result.sigma.pitch.rate);
    });
    EXPECT_GT(larger, 1.5);
  }
}

}  // namespace
}  // namespace canhil::los_rate
