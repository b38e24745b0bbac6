// The unscented transform, its Cholesky factors, and the repair of an indefinite covariance.
#include "target/estimators/filtering/unscented.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "target/estimators/filtering/positive_definite.hpp"
#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::filtering {
namespace {

template <int N, int K>
void expect_columns_of_the_factor() {
  std::mt19937_64 engine(N);
  const Matrix<N, N> P = random_covariance<N>(engine);
  const Dense L = lower_cholesky(P);
  Matrix<even_rows(N), K> columns;
  ASSERT_TRUE((cholesky_columns<K, N>(P, columns)));
  EXPECT_LT(norm(Dense(columns).block(0, 0, N, K) - L.block(0, 0, N, K)), 1e-13);
  const Dense corner = L.block(K, K, N - K, N - K);
  const Dense rest = cholesky_rest<K, N>(P, columns);
  EXPECT_LT(norm(rest - corner * transposed(corner)), 1e-12);
}

TEST(Cholesky, ItsFirstColumnsAndWhatTheyLeave) {
  expect_columns_of_the_factor<15, 9>();
  expect_columns_of_the_factor<18, 9>();
  expect_columns_of_the_factor<6, 2>();
  expect_columns_of_the_factor<7, 4>();
}

TEST(Cholesky, FindsWhatIsNotPositiveDefinite) {
  std::mt19937_64 engine(1);
  const Matrix<7, 7> P = random_covariance<7>(engine);
  EXPECT_TRUE(is_positive_definite<7>(P));
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column <= row; ++column) {
      for (const double bad :
           {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e3}) {
        Matrix<7, 7> broken = P;
        broken(row, column) = bad;
        EXPECT_FALSE(is_positive_definite<7>(broken)) << row << ' ' << column << ' ' << bad;
      }
    }
  }
}

// f(x) = (x0^2, x1 + x2 x0): for a normally distributed x, the moments of f are known in closed form.
TEST(Unscented, MeanOfASquareIsItsVariance) {
  constexpr int N = 3, K = 2;
  std::mt19937_64 engine(2);
  const Matrix<N, N> P = random_covariance<N>(engine);
  const Vector<N> x(0.5, -1, 2);
  const auto f = [](const Vector<N>& at) { return Vector<K>(at(0) * at(0), at(1) + at(2) * at(0)); };
  const auto parts = [&](const Vector<N>& d) {
    const Vector<K> plus = f(x + d), minus = f(x - d);
    return Parts<K>{0.5 * (plus + minus) - f(x), 0.5 * (plus - minus)};
  };
  const auto moments = unscented_moments<K, N>(padded(symmetric_root<N>(P)), 3.0, parts);
  EXPECT_NEAR(moments.shift(0), P(0, 0), 1e-12);  // mean of the square = square of the mean + variance
  EXPECT_NEAR(moments.shift(1), P(0, 2), 1e-12);
  // cov(x2, f) = (row 2 of P) grad f; this is exact for a function of second degree.
  const Vector<2> gradient_0(2 * x(0), 0);
  EXPECT_NEAR(moments.about_central(2, 0), P(2, 0) * gradient_0(0), 1e-12);
  EXPECT_NEAR(moments.about_central(2, 1), P(2, 1) + P(2, 0) * x(2) + P(2, 2) * x(0), 1e-12);
}

TEST(Unscented, SymmetricRootIsSymmetricAndARoot) {
  std::mt19937_64 engine(4);
  const Matrix<6, 6> P = random_covariance<6>(engine);
  const Dense root = symmetric_root<6>(P);
  EXPECT_LT(norm(root - transposed(root)), 1e-13);
  EXPECT_LT(norm(root * root - P), 1e-12);
}

TEST(PositiveDefinite, RepairMendsAndLeavesAloneWhatIsWhole) {
  std::mt19937_64 engine(5);
  const Dense scale = diagonal_matrix(Vector<5>(1e3, 1, 1e-3, 1e-6, 10));
  Matrix<5, 5> P = (scale * random_covariance_dense(5, engine) * scale).fixed<5, 5>();
  const Matrix<5, 5> whole = P;
  EXPECT_FALSE(repair<5>(P));
  EXPECT_EQ(Dense(P), Dense(whole));
  P(1, 0) = P(0, 1) = 1.5 * std::sqrt(P(0, 0) * P(1, 1));  // a correlation beyond 1
  EXPECT_TRUE(repair<5>(P));
  EXPECT_TRUE(is_positive_definite<5>(P));
  EXPECT_LT(std::abs(P(1, 0)), std::sqrt(P(0, 0) * P(1, 1)));
  EXPECT_NEAR(P(3, 3) / whole(3, 3), 1, 0.3) << "small variances keep their scale";
  for (int i = 0; i < 5; ++i) P(2, i) = P(i, 2) = 0;
  P(4, 4) = -1;
  EXPECT_TRUE(repair<5>(P));
  EXPECT_TRUE(is_positive_definite<5>(P));
}

}  // namespace
}  // namespace canhil::filtering
