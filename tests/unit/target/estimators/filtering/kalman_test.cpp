#include "target/estimators/filtering/kalman.hpp"
#include "target/estimators/filtering/cholesky.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::filtering {
namespace {

TEST(Kalman, UpdateIsTheInformationFormAndSymmetric) {
  std::mt19937_64 engine(1);
  const Matrix<7, 7> P = random_covariance<7>(engine);
  const Matrix<2, 7> H = random_matrix<2, 7>(engine);
  const Matrix<2, 2> R = random_covariance<2>(engine);
  const Vector<2> innovation = random_matrix<2, 1>(engine);
  const auto c = update<7, 2>(P, H, R, innovation);
  ASSERT_TRUE(c.positive_definite);
  const Dense h = H, ht = transposed(h), v = innovation;
  EXPECT_LT(largest_difference(c.P, inverse(inverse(P) + ht * inverse(R) * h)), 1e-13);
  EXPECT_LT(largest_difference(c.dx, c.P * ht * inverse(R) * v), 1e-13);
  EXPECT_NEAR(c.nis, dot(v, inverse(h * P * ht + R) * v), 1e-13);
  EXPECT_EQ(Dense(c.P), transposed(c.P));
}

// For a measurement far more precise than the prior, P - K H P is 0 in doubles, but the Joseph form gives R.
TEST(Kalman, JosephFormKeepsTheVarianceOfAPreciseMeasurement) {
  Matrix<2, 2> P;
  P << 1e12, 3e11, 3e11, 1e12;
  const Matrix<1, 1> R(1e-6);
  const auto c = update<2, 1>(P, Matrix<1, 2>(1, 0), R, Vector<1>(0));
  ASSERT_TRUE(c.positive_definite);
  EXPECT_NEAR(c.P(0, 0) / R(0), 1, 1e-6);
  EXPECT_TRUE(is_positive_definite<2>(c.P));
}

TEST(Kalman, RefusesAnInnovationCovarianceThatIsNotPositiveDefinite) {
  const Matrix<2, 2> one = identity(2).fixed<2, 2>(), negative = (-1 * identity(2)).fixed<2, 2>();
  EXPECT_FALSE(
      (update<2, 1>(negative, Matrix<1, 2>(1, 0), Matrix<1, 1>(0.5), Vector<1>(1)).positive_definite));
  const Matrix<1, 1> nan(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE((update<2, 1>(one, Matrix<1, 2>(1, 0), nan, Vector<1>(1)).positive_definite));
}

TEST(Kalman, PositiveDefinitenessNeedsMoreThanAPositiveDiagonal) {
  Matrix<2, 2> P;
  P << 1, 2, 2, 1;
  EXPECT_FALSE(is_positive_definite<2>(P));
  P << 1, 0.5, 0.5, 1;
  EXPECT_TRUE(is_positive_definite<2>(P));
  P(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_positive_definite<2>(P));
}

}  // namespace
}  // namespace canhil::filtering
