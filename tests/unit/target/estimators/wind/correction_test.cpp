// Scalar updates, compared with the matrix equations of the textbook, along the published run.
#include "target/estimators/wind/correction.hpp"
#include "target/estimators/filtering/cholesky.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/target/estimators/reference_matrix.hpp"
#include "tests/unit/target/estimators/wind/recorded_run.hpp"

namespace canhil::wind {
namespace {

Dense dense_H(const StateVector& x) {
  const GroundVelocity at = ground_velocity(x);
  return Dense(9, 12)
      .set(0, air_velocity_at, at.C_bn)
      .set(0, attitude_at, at.by_attitude)
      .set(0, wind_at, identity(3))
      .set(3, rate_at, identity(6));
}

Dense dense_R(const Settings& s) {
  Dense R(9, 9);
  for (int i = 0; i < 3; ++i) {
    R(i, i) = s.velocity_sigma * s.velocity_sigma;
    R(3 + i, 3 + i) = s.rate_sigma * s.rate_sigma;
    R(6 + i, 6 + i) = s.attitude_sigma * s.attitude_sigma;
  }
  return R;
}

// The largest error of an entry P(i, j), divided by sigma_i sigma_j.
double scaled_miss(const Dense& P, const Dense& expected) {
  const Dense sigma = entrywise_roots(diagonal(expected));
  return largest(entrywise_quotient(P - expected, sigma * transposed(sigma)));
}

struct Misses {
  double x = 0, P = 0, nis = 0;
  double asymmetry = 0;
};

struct Posterior {
  Dense dx, P;
};

// Runs the published vector. Compares each update with the dx and P that expected(H, P_prior, innovation)
// returns.
Misses compared(const RecordedRun& run, const Settings& settings,
                const std::function<Posterior(const Dense&, const Dense&, const Dense&)>& expected) {
  Misses worst;
  run.run(make_design(settings),
          [&](std::size_t, const StateVector& x, const Covariance& P, const Answer& answer,
              const StateVector& x_prior, const Covariance& P_prior) {
            const Dense H = dense_H(x_prior);
            const Dense P_dense = P_prior;
            const Dense innovation = answer.innovation;
            const auto [dx, P_expected] = expected(H, P_dense, innovation);
            const Dense sigma = entrywise_roots(diagonal(P_expected));
            worst.x = std::max(worst.x, largest(entrywise_quotient(Dense(x) - x_prior - dx, sigma)));
            worst.P = std::max(worst.P, scaled_miss(P, P_expected));
            worst.asymmetry = std::max(worst.asymmetry, largest_difference(P, transposed(P)));
            const Dense S = H * P_dense * transposed(H) + dense_R(settings);
            const double nis = dot(innovation, inverse(S) * innovation);
            worst.nis = std::max(worst.nis, std::abs(answer.nis - nis) / nis);
            EXPECT_TRUE(filtering::is_positive_definite<12>(P));
          });
  return worst;
}

Posterior kalman(const Dense& H, const Dense& P, const Dense& innovation, const Dense& R) {
  const Dense S = H * P * transposed(H) + R;
  const Dense K = P * transposed(H) * inverse(S);
  return {K * innovation, P - K * H * P};
}

TEST(WindCorrection, ScalarUpdatesAreTheKalmanUpdate) {
  const RecordedRun run;
  const Dense R = dense_R(run.settings);
  const Misses worst = compared(
      run, run.settings,
      [&](const Dense& H, const Dense& P, const Dense& innovation) { return kalman(H, P, innovation, R); });
  EXPECT_LT(worst.x, 1e-9);
  EXPECT_LT(worst.P, 1e-9);
  EXPECT_LT(worst.nis, 1e-9);
  EXPECT_EQ(worst.asymmetry, 0);
}

// The expected covariance is P~ = Pu + Pu L' S^1/2 [I/theta - B]^-1 S^1/2 L Pu, and the expected gain is
// K = P~ H' R^-1. In S, the rates have the weight 3.
TEST(WindCorrection, HInfinityIsTheFormWithoutInverseOfP) {
  const RecordedRun run;
  Settings settings = run.settings;
  settings.algorithm = Algorithm::h_infinity;
  settings.rate_weight = 3;
  const Dense R = dense_R(settings);
  const Misses worst = compared(run, settings, [&](const Dense& H, const Dense& P, const Dense& innovation) {
    const Dense Pu = kalman(H, P, innovation, R).P;
    Dense SL = Dense(6, 12).set(0, 0, identity(3)).set(3, 3, std::sqrt(3.0) * identity(3));
    const Dense margin = identity(6) / 0.03 - SL * Pu * transposed(SL);
    const Dense inflated = Pu + Pu * transposed(SL) * inverse(margin) * SL * Pu;
    const Dense dx = inflated * transposed(H) * inverse(R) * innovation;
    return Posterior{dx, inflated};
  });
  EXPECT_LT(worst.x, 1e-8);
  EXPECT_LT(worst.P, 1e-9);
  EXPECT_EQ(worst.asymmetry, 0);
}

// Eqs. (24)-(27) as printed: P~^-1 = P^-1 - theta L' S L + H' R^-1 H, and K = P~ H' R^-1.
TEST(WindCorrection, Eq24To27PrintedRecursionMatches) {
  const RecordedRun run;
  Settings settings = run.settings;
  settings.algorithm = Algorithm::h_infinity;
  const Dense R = dense_R(settings);
  const Misses worst = compared(run, settings, [&](const Dense& H, const Dense& P, const Dense& innovation) {
    const Dense S_bar = Dense(12, 12).set(0, 0, identity(6));
    const Dense information = inverse(P) - 0.03 * S_bar + transposed(H) * inverse(R) * H;
    const Dense inflated = inverse(information);
    const Dense dx = inflated * transposed(H) * inverse(R) * innovation;
    return Posterior{dx, inflated};
  });
  EXPECT_LT(worst.x, 1e-6);
  EXPECT_LT(worst.P, 1e-6);
}

TEST(WindCorrection, ThetaOfZeroIsTheEkf) {
  const RecordedRun run;
  Settings settings = run.settings;
  std::vector<StateVector> ekf;
  run.run(make_design(settings), [&](std::size_t, const StateVector& x, const Covariance&, const Answer&,
                                     const StateVector&, const Covariance&) { ekf.push_back(x); });
  settings.algorithm = Algorithm::h_infinity;
  for (const double theta : {0.0, 1e-18}) {
    settings.theta_per_s = theta / settings.sample_period;
    double worst = 0;
    run.run(make_design(settings),
            [&](std::size_t k, const StateVector& x, const Covariance&, const Answer&, const StateVector&,
                const Covariance&) { worst = std::max(worst, largest_difference(x, ekf[k])); });
    EXPECT_LT(worst, 1e-12) << theta;
  }
}

// theta is lowered exactly where theta lambda_max(B) would exceed the cap; the product then equals the cap.
TEST(WindCorrection, ThetaIsLoweredToTheCap) {
  const RecordedRun run;
  Settings settings = run.settings;
  settings.algorithm = Algorithm::h_infinity;
  settings.theta_per_s = 0.1 / settings.sample_period;
  const Dense R = dense_R(settings);
  int capped = 0;
  run.run(make_design(settings),
          [&](std::size_t k, const StateVector&, const Covariance& P, const Answer& answer,
              const StateVector& x_prior, const Covariance& P_prior) {
            const Dense Pu = kalman(dense_H(x_prior), P_prior, answer.innovation, R).P;
            const double lambda = symmetric_eigenvalues(Pu.block(0, 0, 6, 6)).back();
            EXPECT_EQ(answer.theta_capped, 0.1 * lambda > 0.04) << k;
            EXPECT_NEAR(answer.theta, std::min(0.1, 0.04 / lambda), 1e-9) << k;
            EXPECT_TRUE(filtering::is_positive_definite<12>(P));
            if (answer.theta_capped) ++capped;
          });
  EXPECT_GT(capped, 5);
  EXPECT_LT(capped, 900);
}

TEST(WindCorrection, ThetaIsProportionalToTheInterval) {
  const RecordedRun run;
  Settings settings = run.settings;
  settings.algorithm = Algorithm::h_infinity;
  settings.theta_per_s = 0.05;
  const Design design = make_design(settings);
  for (const double interval : {0.01, 0.02, 0.1}) {
    StateVector x = run.x0;
    Covariance P = run.P0;
    EXPECT_DOUBLE_EQ(update(x, P, run.y[0], interval, design).theta, 0.05 * interval);
  }
}

// P~ does not exist for theta lambda_max = 1, so a cap that would permit this value is reduced.
TEST(WindCorrection, NoSettingMakesTheInflationSingular) {
  const RecordedRun run;
  Settings settings = run.settings;
  settings.algorithm = Algorithm::h_infinity;
  settings.theta_per_s = 1e6;
  settings.theta_cap_per_s = 1e6;
  StateVector x = run.x0;
  Covariance P = run.P0;
  EXPECT_TRUE(update(x, P, run.y[0], 0.02, make_design(settings)).theta_capped);
  EXPECT_TRUE(filtering::is_positive_definite<12>(P));
}

}  // namespace
}  // namespace canhil::wind
