// Predictions that skip the zeros of the transition matrix, compared with the dense prediction.
#include "target/estimators/filtering/block_transition.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil::filtering {
namespace {

TEST(Kalman, BlockPredictionIsTheDenseOne) {
  static constexpr std::array<Block, 4> pattern{{{0, 1}, {1, 1}, {2, 0}, {0, 2}}};
  std::mt19937_64 engine(4);
  const Matrix<9, 9> P = random_covariance<9>(engine);
  Dense G(9, 9);
  for (const Block b : pattern) G.set(3 * b.row, 3 * b.column, random_dense(3, 3, engine));
  const Dense Phi = identity(9) + G;
  const Dense dense = propagate_covariance<9>(P, Phi.fixed<9, 9>(), Dense(9, 9).fixed<9, 9>());
  const Dense blocks = propagate_covariance_blocks<pattern, 9>(P, G.fixed<9, 9>());
  EXPECT_LT(largest_difference(dense, blocks), 1e-12);
  EXPECT_EQ(blocks, transposed(blocks));
  EXPECT_LT(largest_difference(dense, Phi * P * transposed(Phi)), 1e-12);
}

TEST(BlockTransition, MovingStatesAloneGiveTheDenseRecursion) {
  std::mt19937_64 engine(6);
  constexpr int N = 7, K = 5;
  const Matrix<N, N> P = random_covariance<N>(engine);
  const Dense G = random_dense(K, N, engine);
  const Dense Phi = identity(N) + Dense(N, N).set(0, 0, G);
  const Dense next = propagate_covariance_moving<K, N>(
      P, [&]<int Rows>(const Matrix<Rows, N>& M) { return (M * transposed(G)).template fixed<Rows, K>(); });
  EXPECT_LT(norm(next - Phi * P * transposed(Phi)), 1e-12);
  EXPECT_EQ(next, transposed(next));
}

}  // namespace
}  // namespace canhil::filtering
