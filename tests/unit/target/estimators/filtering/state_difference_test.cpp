// Compares the update that measures a difference of states with the update that uses the equivalent matrix H.
#include "target/estimators/filtering/kalman.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::filtering {
namespace {

TEST(Kalman, UpdateByADifferenceOfStatesIsTheUpdateByItsH) {
  std::mt19937_64 engine(7);
  const Matrix<7, 7> P = random_covariance<7>(engine);
  const Matrix<2, 2> R = random_covariance<2>(engine);
  const Vector<2> innovation = random_matrix<2, 1>(engine);
  const Dense H = Dense(2, 7).set(0, 1, identity(2)).set(0, 5, -1 * identity(2));
  const auto expected = update<7, 2>(P, H.fixed<2, 7>(), R, innovation);
  const auto got = update_state_difference<1, 5, 7, 2>(P, R, innovation);
  EXPECT_LT(norm(Dense(got.P) - expected.P), 1e-13);
  EXPECT_LT(norm(Dense(got.dx) - expected.dx), 1e-13);
  EXPECT_NEAR(got.nis, expected.nis, 1e-13);
}

}  // namespace
}  // namespace canhil::filtering
