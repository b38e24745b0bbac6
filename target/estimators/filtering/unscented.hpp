#pragma once
// The unscented transform (Julier, Uhlmann 2004) of a map of which only the first K of N states move and the
// others keep their value. Sigma points x, x +- sqrt(spread) columns of a root of P, weights 1/(2 spread)
// each and the rest on the centre. In differences to the centre's image the centre drops out, and a pair of
// points enters by its even and odd part.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "target/estimators/filtering/kalman.hpp"

namespace canhil::filtering {

/// The first K columns of the lower Cholesky factor of P and what they leave: P = columns columns' + [0 0; 0
/// rest].
template <int N, int K>
struct PartialRoot {
  bool positive_definite = false;  // of P; when false nothing else is set
  Matrix<N, K> columns;
  Matrix<N - K, N - K> rest;
};

template <int K, int N>
PartialRoot<N, K> partial_cholesky(const Matrix<N, N>& P) {
  PartialRoot<N, K> root;
  Matrix<N, N> left = P;  // lower triangle
  for (int j = 0; j < K; ++j) {
    if (!(left(j, j) > 0)) return root;
    const double pivot = std::sqrt(left(j, j));
    const double inverse = 1 / pivot;
    for (int i = 0; i < j; ++i) root.columns(i, j) = 0;
    root.columns(j, j) = pivot;
    for (int i = j + 1; i < N; ++i) root.columns(i, j) = left(i, j) * inverse;
    for (int column = j + 1; column < N; ++column) {
      const double factor = root.columns(column, j);
      for (int i = column; i < N; ++i) left(i, column) -= root.columns(i, j) * factor;
    }
  }
  root.rest = left.template bottomRightCorner<N - K, N - K>();
  mirror_lower<N - K>(root.rest);
  root.positive_definite = Eigen::LLT<Matrix<N - K, N - K>>(root.rest).info() == Eigen::Success;
  return root;
}

/// The symmetric root of P, positive semi-definite.
template <int N>
Matrix<N, N> symmetric_root(const Matrix<N, N>& P) {
  const Eigen::SelfAdjointEigenSolver<Matrix<N, N>> solver(P);
  const Matrix<N, N> scaled =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().cwiseSqrt().asDiagonal();
  return scaled.lazyProduct(scaled.transpose());
}

/// Half the sum and half the difference of a map's images of x + d and x - d, less the centre's image in the
/// sum.
template <int K>
struct Parts {
  Vector<K> even, odd;
};

/// Moments of the moved states: mean less the centre's image, second moment about the centre's image, and the
/// covariance with the states that stay.
template <int N, int K>
struct Moments {
  Vector<K> shift;
  Matrix<K, K> about_central;
  Matrix<N - K, K> cross;
};

/// The transform over the given columns of a root; parts(d) gives the Parts of the map for an offset d.
template <int K, int N, int Columns, class PartsOf>
Moments<N, K> unscented_moments(const Matrix<N, Columns>& root, double spread, const PartsOf& parts) {
  const double reach = std::sqrt(spread);
  Matrix<K, Columns> even, odd;
  for (int j = 0; j < Columns; ++j) {
    const Parts<K> moved = parts(Vector<N>(reach * root.col(j)));
    even.col(j) = moved.even;
    odd.col(j) = moved.odd;
  }
  const double weight = 1 / spread;
  Moments<N, K> moments;
  moments.shift = weight * even.rowwise().sum();
  moments.about_central.noalias() = weight * odd.lazyProduct(odd.transpose());
  moments.about_central.noalias() += weight * even.lazyProduct(even.transpose());
  moments.cross.noalias() = (1 / reach) * root.template bottomRows<N - K>().lazyProduct(odd.transpose());
  return moments;
}

}  // namespace canhil::filtering
