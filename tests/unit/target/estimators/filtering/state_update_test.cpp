// Compares the update that measures states directly with the update that uses the equivalent matrix H.
#include "target/estimators/filtering/kalman.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::filtering {
namespace {

TEST(Kalman, MeasuringStatesIsMeasuringThemThroughH) {
  std::mt19937_64 engine(2);
  const Matrix<9, 9> P = random_covariance<9>(engine);
  const Matrix<3, 3> R = random_covariance<3>(engine);
  const Vector<3> innovation = random_matrix<3, 1>(engine);
  const Dense H = Dense(3, 9).set(0, 4, identity(3));
  const auto direct = update_states<4, 9, 3>(P, R, innovation);
  const auto general = update<9, 3>(P, H.fixed<3, 9>(), R, innovation);
  EXPECT_LT(largest_difference(direct.P, general.P), 1e-14);
  EXPECT_LT(largest_difference(direct.dx, general.dx), 1e-14);
}

}  // namespace
}  // namespace canhil::filtering
