#include "target/estimators/filtering/robust_h2.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::filtering {
namespace {

TEST(RobustH2, LargestEigenvalueAgreesWithTheIterativeSolver) {
  std::mt19937_64 engine(1);
  for (int k = 0; k < 100; ++k) {
    const Matrix<3, 3> m = random_covariance<3>(engine);
    EXPECT_NEAR(largest_eigenvalue<3>(m) / symmetric_eigenvalues(m)[2], 1, 1e-14);
  }
  EXPECT_NEAR(largest_eigenvalue<3>((1e-9 * identity(3)).fixed<3, 3>()), 1e-9, 1e-23)
      << "threefold eigenvalue";
  EXPECT_NEAR(largest_eigenvalue<5>((2 * identity(5)).fixed<5, 5>()), 2, 1e-15);
}

TEST(RobustH2, BetaIsZeroWhenATermVanishes) {
  EXPECT_DOUBLE_EQ(h2_beta(2, 1), 2);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double nothing : {0.0, -1e-30, std::nan(""), infinity}) {
    EXPECT_EQ(h2_beta(nothing, 1), 0) << nothing;
    EXPECT_EQ(h2_beta(1, nothing), 0) << nothing;
  }
}

// The purpose of the step: for every |Delta| <= 1, its P is an upper bound of the true covariance of the
// system A + L Delta N (to first order in dt).
TEST(RobustH2, StepBoundsEveryUncertainSystem) {
  std::mt19937_64 engine(2);
  const double dt = 1e-4;
  const Matrix<4, 4> P = random_covariance<4>(engine), A = random_matrix<4, 4>(engine);
  const Matrix<4, 4> Q = identity(4).fixed<4, 4>();
  const Matrix<4, 2> L = random_matrix<4, 2>(engine);
  const Matrix<2, 4> N = random_matrix<2, 4>(engine);
  const Dense NP = Dense(N) * P;
  const double beta = h2_beta(largest_eigenvalue<2>((NP * transposed(NP)).fixed<2, 2>()),
                              largest_eigenvalue<2>((transposed(L) * L).fixed<2, 2>()));
  const Dense bound = propagate_h2<4, 2, 2>(P, A, Q, L, N, beta, dt);
  for (int k = 0; k < 200; ++k) {
    Dense Delta = random_dense(2, 2, engine);
    Delta = Delta / largest_stretch(Delta);
    const Dense uncertain = A + L * Delta * N;
    const Dense truth = propagate_h2<4, 2, 2>(P, uncertain.fixed<4, 4>(), Q, L, N, 0, dt);
    // The limit of -0.05 allows for the neglected terms of the order dt * |A|^2 |P|.
    EXPECT_GT(symmetric_eigenvalues((bound - truth) / dt)[0], -0.05);
  }
}

TEST(RobustH2, StepAddsTheTermsOfTheRiccatiEquation) {
  std::mt19937_64 engine(3);
  const double dt = 1e-6, beta = 0.7;
  const Matrix<4, 4> P = random_covariance<4>(engine), A = random_matrix<4, 4>(engine);
  const Matrix<4, 4> Q = identity(4).fixed<4, 4>();
  const Matrix<4, 2> L = random_matrix<4, 2>(engine);
  const Matrix<2, 4> N = random_matrix<2, 4>(engine);
  const Dense rate = (propagate_h2<4, 2, 2>(P, A, Q, L, N, beta, dt) - Dense(P)) / dt;
  // The published filter has P N'N/beta in Phi. Phi multiplies P from both sides, so P N'N P/beta is added
  // twice.
  const Dense p = P, NP = N * p, Ap = A * p;
  const Dense expected =
      Ap + transposed(Ap) + 2 / beta * transposed(NP) * NP + beta * Dense(L) * transposed(L) + Q;
  EXPECT_LT(largest_difference(rate, expected) / largest(expected), 1e-4);
}

}  // namespace
}  // namespace canhil::filtering
