#pragma once
// Lower Cholesky factors of up to 20 rows, left-looking: each column is finished in registers before it is
// stored. Compiled once for all sizes: the template parameter in cholesky.cpp is the number of remaining
// rows, not N.
#include "target/estimators/filtering/kalman.hpp"

namespace canhil::filtering {
namespace detail {

inline constexpr int most_cholesky_rows = 20;

// Computes the first `columns` columns of L [even_rows(N) x columns] from P [N x N]; both are stored by
// columns.
bool cholesky_columns(const double* P, int N, double* L, int columns);
// Computes the lower triangle of `rest` [N - columns x N - columns].
void cholesky_rest(const double* P, int N, const double* L, int columns, double* rest);

}  // namespace detail

/// The first K columns of the lower Cholesky factor of P [N x N] (only the lower triangle of P is read), with
/// one row of padding if N is odd. False: P's leading K x K block is not positive definite, or not finite.
template <int K, int N>
bool cholesky_columns(const Matrix<N, N>& P, Matrix<even_rows(N), K>& L) {
  static_assert(K <= N && N <= detail::most_cholesky_rows);
  return detail::cholesky_columns(P.data(), N, L.data(), K);
}

/// The Schur complement of P's leading block: P's lower right block minus the contribution of the first K
/// columns of L; symmetric.
template <int K, int N>
Matrix<N - K, N - K> cholesky_rest(const Matrix<N, N>& P, const Matrix<even_rows(N), K>& L) {
  static_assert(K < N && N <= detail::most_cholesky_rows);
  Matrix<N - K, N - K> rest;
  detail::cholesky_rest(P.data(), N, L.data(), K, rest.data());
  mirror_lower<N - K>(rest);
  return rest;
}

/// True if a symmetric matrix is finite and positive definite. Only the lower triangle is read. A NaN or an
/// infinity in any element is detected, because it reaches a pivot.
template <int N>
bool is_positive_definite(const Matrix<N, N>& P) {
  Matrix<even_rows(N), N> L;
  return cholesky_columns<N, N>(P, L);
}

}  // namespace canhil::filtering
