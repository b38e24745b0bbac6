#pragma once
// Generic Kalman recursions of fixed size: N states, M measurements. No allocation, no exception.
#include <Eigen/Core>
#include <cmath>

namespace canhil::filtering {

template <int Rows, int Cols>
using Matrix = Eigen::Matrix<double, Rows, Cols>;
template <int Rows>
using Vector = Eigen::Matrix<double, Rows, 1>;

/// The number of rows, rounded up to an even number: Eigen uses whole SIMD packets only for an even number of
/// rows.
constexpr int even_rows(int rows) { return rows + rows % 2; }

/// M with an additional row of zeros if its number of rows is odd.
template <class Derived>
auto padded(const Eigen::MatrixBase<Derived>& M) {
  constexpr int rows = Derived::RowsAtCompileTime;
  Matrix<even_rows(rows), Derived::ColsAtCompileTime> out;
  out.template topRows<rows>() = M;
  if constexpr (rows % 2 != 0) out.row(rows).setZero();
  return out;
}

/// Copies the lower triangle into the upper, for exact symmetry after computing only one half.
template <int N>
void mirror_lower(Matrix<N, N>& P) {
  for (int column = 1; column < N; ++column)
    for (int row = 0; row < column; ++row) P(row, column) = P(column, row);
}

/// Replaces each pair of mirrored elements by its mean.
template <int N>
void average_with_transpose(Matrix<N, N>& P) {
  for (int column = 0; column < N; ++column)
    for (int row = column + 1; row < N; ++row)
      P(row, column) = P(column, row) = 0.5 * (P(row, column) + P(column, row));
}

/// P+ = Phi P Phi' + Q, symmetric.
template <int N>
Matrix<N, N> propagate_covariance(const Matrix<N, N>& P, const Matrix<N, N>& Phi, const Matrix<N, N>& Q) {
  const Matrix<N, N> PhiP = Phi.lazyProduct(P);
  Matrix<N, N> next = Q;
  next.noalias() += PhiP.lazyProduct(Phi.transpose());
  mirror_lower<N>(next);
  return next;
}

/// Computes the inverse of a symmetric S; reads only the lower triangle of S. Factorises S = L L' (Cholesky),
/// solves L Y = I for Y, and then solves L' X = Y for the inverse X. False: S is not positive definite or not
/// finite. Written by hand: Eigen's triangular solver would also instantiate Eigen's product of large
/// matrices, which adds more than a second to every compilation.
template <int M>
bool invert_positive_definite(const Matrix<M, M>& S, Matrix<M, M>& inverse) {
  Matrix<M, M> L = S;
  for (int k = 0; k < M; ++k) {
    double square = 0;
    for (int j = 0; j < k; ++j) square += L(k, j) * L(k, j);
    const double pivot = L(k, k) - square;
    if (pivot <= 0) return false;
    L(k, k) = std::sqrt(pivot);
    for (int row = k + 1; row < M; ++row) {
      double product = 0;
      for (int j = 0; j < k; ++j) product += L(row, j) * L(k, j);
      L(row, k) = (L(row, k) - product) / L(k, k);
    }
  }
  if (!S.allFinite()) return false;
  inverse.setIdentity();
  for (int column = 0; column < M; ++column) {
    for (int k = 0; k < M; ++k) {
      inverse(k, column) *= 1 / L(k, k);
      for (int row = k + 1; row < M; ++row) inverse(row, column) -= inverse(k, column) * L(row, k);
    }
    for (int k = M - 1; k >= 0; --k) {
      double product = 0;
      for (int row = k + 1; row < M; ++row) product += L(row, k) * inverse(row, column);
      inverse(k, column) = (inverse(k, column) - product) * (1 / L(k, k));
    }
  }
  return true;
}

/// The outcome of a measurement update: the correction dx (the gain K times the innovation), the posterior P,
/// and the innovation statistic (NIS).
template <int N, int M>
struct Correction {
  bool positive_definite = false;  // S is positive definite; if false, only S is set
  Vector<N> dx;
  Matrix<N, N> P;
  Matrix<N, M> K;
  Matrix<M, M> S;  // innovation covariance H P H' + R
  double nis =
      0;  // innovation' S^-1 innovation: chi-squared with M degrees of freedom if the filter is consistent
};

namespace detail {

template <int N, int M>
using Padded = Matrix<even_rows(N), M>;

// Joseph form (I - K H) P (I - K H)' + K R K'. The caller provides the products with H: PHt = P H', and
// times_Ht(W) = W H' for a W that is padded to an even number of rows. Computes W = (I - K H) P and then
// P+ = W + (K R - W H') K'; for the optimal K, the expression in brackets is zero.
template <int N, int M, class TimesHt>
Correction<N, M> joseph(const Matrix<N, N>& P, const Matrix<N, M>& PHt, const Matrix<M, M>& HPHt,
                        const Matrix<M, M>& R, const Vector<M>& innovation, TimesHt times_Ht) {
  Correction<N, M> c;
  c.S = HPHt + R;
  Matrix<M, M> S_inverse;
  c.positive_definite = invert_positive_definite<M>(c.S, S_inverse);
  if (!c.positive_definite) return c;
  c.K.noalias() = PHt.lazyProduct(S_inverse);
  c.dx.noalias() = c.K.lazyProduct(innovation);
  c.nis = innovation.dot(S_inverse * innovation);
  const auto K = padded(c.K);
  auto W = padded(P);
  W.noalias() -= K.lazyProduct(PHt.transpose());
  const Matrix<even_rows(N), M> bracket = K.lazyProduct(R) - times_Ht(W);
  W.noalias() += bracket.lazyProduct(c.K.transpose());
  c.P = W.template topRows<N>();
  average_with_transpose<N>(c.P);
  return c;
}

}  // namespace detail

/// Updates the covariance P by a measurement z = H x + v, where v has zero mean and the covariance R. Uses
/// the Joseph form and makes the result exactly symmetric.
template <int N, int M>
Correction<N, M> update(const Matrix<N, N>& P, const Matrix<M, N>& H, const Matrix<M, M>& R,
                        const Vector<M>& innovation) {
  const Matrix<N, M> PHt = P.lazyProduct(H.transpose());
  const Matrix<M, M> HPHt = H.lazyProduct(PHt);
  return detail::joseph<N, M>(P, PHt, HPHt, R, innovation, [&](const auto& W) -> detail::Padded<N, M> {
    return W.lazyProduct(H.transpose());
  });
}

/// update() for a direct measurement of the states First to First + M - 1; computes no products with H.
template <int First, int N, int M>
Correction<N, M> update_states(const Matrix<N, N>& P, const Matrix<M, M>& R, const Vector<M>& innovation) {
  return detail::joseph<N, M>(
      P, P.template middleCols<M>(First), P.template block<M, M>(First, First), R, innovation,
      [](const auto& W) -> detail::Padded<N, M> { return W.template middleCols<M>(First); });
}

/// update() for a measurement of the difference of two groups of M states: the group that begins at First
/// minus the group that begins at Less.
template <int First, int Less, int N, int M>
Correction<N, M> update_state_difference(const Matrix<N, N>& P, const Matrix<M, M>& R,
                                         const Vector<M>& innovation) {
  const auto times_Ht = [](const auto& W) -> detail::Padded<N, M> {
    return W.template middleCols<M>(First) - W.template middleCols<M>(Less);
  };
  const Matrix<N, M> PHt = P.template middleCols<M>(First) - P.template middleCols<M>(Less);
  const Matrix<M, M> HPHt = PHt.template middleRows<M>(First) - PHt.template middleRows<M>(Less);
  return detail::joseph<N, M>(P, PHt, HPHt, R, innovation, times_Ht);
}

}  // namespace canhil::filtering
