#pragma once
// Lower Cholesky factors of fixed size, left-looking: a column is finished in registers before it is stored.
#include <cmath>
#include <limits>
#include <utility>

#include "target/estimators/filtering/kalman.hpp"

namespace canhil::filtering {
namespace detail {

// Column c of P less what the first `done` columns of L account for; rows from c (or one above it) down.
template <int c, int N, int K>
auto column_left(const Matrix<N, N>& P, const Matrix<even_rows(N), K>& L, int done) {
  constexpr int first = c - c % 2, rows = even_rows(N) - first;
  Vector<rows> left;
  left.template head<N - first>() = P.col(c).template tail<N - first>();
  if constexpr (N % 2 != 0) left(rows - 1) = 0;
  for (int j = 0; j < done; ++j) left.noalias() -= L(c, j) * L.col(j).template tail<rows>();
  return left;
}

}  // namespace detail

/// The first K columns of the lower Cholesky factor of P [N x N] (lower triangle read), with one row of
/// padding where N is odd; false: P's leading K x K block is not positive definite, or not finite.
template <int K, int N>
bool cholesky_columns(const Matrix<N, N>& P, Matrix<even_rows(N), K>& L) {
  const auto column = [&]<int c>() {
    constexpr int first = c - c % 2;
    const auto left = detail::column_left<c, N, K>(P, L, c);
    const double pivot = left(c - first);
    if (!(pivot > 0 && pivot <= std::numeric_limits<double>::max())) return false;
    L.col(c).template head<first>().setZero();
    L.col(c).template tail<even_rows(N) - first>() = left * (1 / std::sqrt(pivot));
    if constexpr (c % 2 != 0) L(c - 1, c) = 0;
    return true;
  };
  return [&]<int... c>(std::integer_sequence<int, c...>) { return (column.template operator()<c>() && ...); }
  (std::make_integer_sequence<int, K>{});
}

/// What K columns of the factor leave of P: the lower right block less their product, symmetric.
template <int K, int N>
Matrix<N - K, N - K> cholesky_rest(const Matrix<N, N>& P, const Matrix<even_rows(N), K>& L) {
  Matrix<N - K, N - K> rest;
  [&]<int... c>(std::integer_sequence<int, c...>) {
    ((rest.col(c).template tail<N - K - c>() =
          detail::column_left<K + c, N, K>(P, L, K).template segment<N - K - c>((K + c) % 2)),
     ...);
  }
  (std::make_integer_sequence<int, N - K>{});
  mirror_lower<N - K>(rest);
  return rest;
}

/// True when a symmetric matrix (lower triangle read) is finite and positive definite: a NaN or infinity
/// anywhere reaches a pivot.
template <int N>
bool is_positive_definite(const Matrix<N, N>& P) {
  Matrix<even_rows(N), N> L = Matrix<even_rows(N), N>::Zero();
  return cholesky_columns<N, N>(P, L);
}

}  // namespace canhil::filtering
