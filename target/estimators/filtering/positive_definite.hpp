#pragma once
// What to do with a covariance that has lost its positive definiteness.
#include <Eigen/Eigenvalues>

#include "target/estimators/filtering/cholesky.hpp"

namespace canhil::filtering {

/// The covariance P scaled to a correlation matrix, its eigenvalues raised to at least `floor`, and scaled
/// back. Variances below 1e-30 are taken as 1e-30 and negative ones by their size, so that the result is
/// positive definite for every finite P.
template <int N>
Matrix<N, N> with_eigenvalue_floor(const Matrix<N, N>& P, double floor = 1e-9) {
  const Vector<N> sigma = P.diagonal().cwiseAbs().cwiseMax(1e-30).cwiseSqrt();
  const Vector<N> weight = sigma.cwiseInverse();
  const Matrix<N, N> correlation = weight.asDiagonal() * P * weight.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix<N, N>> solver(correlation);
  const Vector<N> root = solver.eigenvalues().cwiseMax(floor).cwiseSqrt();
  const Matrix<N, N> scaled = sigma.asDiagonal() * solver.eigenvectors() * root.asDiagonal();
  return scaled.lazyProduct(scaled.transpose());
}

/// P made positive definite where it is not; true: it was not.
template <int N>
bool repair(Matrix<N, N>& P) {
  if (is_positive_definite<N>(P)) return false;
  P = with_eigenvalue_floor<N>(P);
  return true;
}

}  // namespace canhil::filtering
