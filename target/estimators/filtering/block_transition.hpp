#pragma once
// Covariance prediction for Phi = I + G, where most of G is zero by construction.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>

#include "target/estimators/filtering/kalman.hpp"

namespace canhil::filtering {

/// The place of a 3 x 3 block in a matrix.
struct Block {
  int row = 0, column = 0;  // in blocks of 3
};

/// (I + G) P (I + G)' for symmetric P [N x N]; reads only the 3x3 blocks of G in `pattern` (std::array of
/// Block). Needs at most 18 N multiplications for each block of `pattern`; full matrix products would need
/// 2 N^3 in total.
template <auto pattern, int N>
Matrix<N, N> propagate_covariance_blocks(const Matrix<N, N>& P, const Matrix<N, N>& G) {
  static_assert(N % 3 == 0);
  // Works on whole columns, which are contiguous. As P is symmetric, X = P + P G' leads to P+ = X' + X' G'.
  // Only the lower triangle of P+ is computed.
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

/// (I + G) P (I + G)' for symmetric P [N x N] and for a G that changes only the first K states: all rows of G
/// after the K-th are zero. times_Gt(M) returns M G' [rows x K] for any M [rows x N] and may exploit more
/// zeros of G.
template <int K, int N, class TimesGt>
Matrix<N, N> propagate_covariance_moving(const Matrix<N, N>& P, const TimesGt& times_Gt) {
  const auto rows = padded(P);
  const Matrix<even_rows(N), K> X = rows.template leftCols<K>() + times_Gt(rows);
  const auto Xt = padded(X.template topRows<N>().transpose());  // [K x N]
  const Matrix<even_rows(K), K> Y = Xt.template leftCols<K>() + times_Gt(Xt);
  Matrix<N, N> next = P;
  next.template topLeftCorner<K, K>() = Y.template topRows<K>();
  next.template bottomLeftCorner<N - K, K>() = X.template middleRows<N - K>(K);
  mirror_lower<N>(next);
  return next;
}

}  // namespace canhil::filtering
