#pragma once
// Repairs a covariance that has lost its positive definiteness.
#include "target/estimators/filtering/cholesky.hpp"
#include "target/estimators/filtering/symmetric_eigen.hpp"

namespace canhil::filtering {

/// Scales the covariance P to a correlation matrix, raises the eigenvalues of this matrix to at least
/// `floor`, and scales back. The scaling uses the magnitude of each variance, or 1e-30 if the magnitude is
/// smaller, so that the result is positive definite for every finite P.
template <int N>
Matrix<N, N> with_eigenvalue_floor(const Matrix<N, N>& P, double floor = 1e-9) {
  const Vector<N> sigma = P.diagonal().cwiseAbs().cwiseMax(1e-30).cwiseSqrt();
  const Vector<N> weight = sigma.cwiseInverse();
  const Matrix<N, N> correlation = weight.asDiagonal() * P * weight.asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(correlation);
  const Vector<N> root = Vector<N>(eigen.values).cwiseMax(floor).cwiseSqrt();
  const Matrix<N, N> scaled = sigma.asDiagonal() * Matrix<N, N>(eigen.vectors) * root.asDiagonal();
  return scaled.lazyProduct(scaled.transpose());
}

/// Makes P positive definite if it is not. True: P was changed.
template <int N>
bool repair(Matrix<N, N>& P) {
  if (is_positive_definite<N>(P)) return false;
  P = with_eigenvalue_floor<N>(P);
  return true;
}

}  // namespace canhil::filtering
