#pragma once
// Covariance prediction when Phi = I + G and G has few non-zero 3x3 blocks, known at compile time.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>

#include "target/estimators/filtering/kalman.hpp"

namespace canhil::filtering {

struct Block {
  int row = 0, column = 0;  // in blocks of 3
};

/// (I + G) P (I + G)' for symmetric P [N x N]; of G only the 3x3 blocks in `pattern` (std::array of Block)
/// are read. Costs 27 N multiplications a block in place of 2 N^3.
template <auto pattern, int N>
Matrix<N, N> propagate_covariance_blocks(const Matrix<N, N>& P, const Matrix<N, N>& G) {
  static_assert(N % 3 == 0);
  // By columns (contiguous): X = P + P G', then, as P is symmetric, P+ = X' + X' G'; its lower triangle
  // suffices.
  Matrix<N, N> X = P;
  const auto right = [&]<std::size_t I>() {
    constexpr int i = 3 * pattern[I].row, j = 3 * pattern[I].column;
    X.template middleCols<3>(i).noalias() +=
        P.template middleCols<3>(j).lazyProduct(G.template block<3, 3>(i, j).transpose());
  };
  const auto each = [&]<std::size_t... I>(std::index_sequence<I...>, const auto& apply) {
    (apply.template operator()<I>(), ...);
  };
  constexpr auto blocks = std::make_index_sequence<pattern.size()>{};
  each(blocks, right);
  const Matrix<N, N> Xt = X.transpose();
  Matrix<N, N> next = Xt;
  const auto left = [&]<std::size_t I>() {
    constexpr int i = 3 * pattern[I].row, j = 3 * pattern[I].column;
    next.template block<N - i, 3>(i, i).noalias() +=
        Xt.template block<N - i, 3>(i, j).lazyProduct(G.template block<3, 3>(i, j).transpose());
  };
  each(blocks, left);
  mirror_lower<N>(next);
  return next;
}

}  // namespace canhil::filtering
