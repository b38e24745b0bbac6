#pragma once
// The unscented transform (Julier, Uhlmann 2004) of a map that changes only the first K of N states. Sigma
// points: the centre x, and x +- sqrt(spread) times each column of a root of P. The centre has the weight
// 1 - N/spread, every other point 1/(2 spread). Moments are computed relative to the image of the centre, so
// the centre does not contribute; each pair of points contributes by its even and odd part.
#include <cmath>

#include "target/estimators/filtering/kalman.hpp"
#include "target/estimators/filtering/symmetric_eigen.hpp"

namespace canhil::filtering {

/// The symmetric root of P, positive semi-definite.
template <int N>
Matrix<N, N> symmetric_root(const Matrix<N, N>& P) {
  const SymmetricEigen eigen = symmetric_eigen(P);
  const Matrix<N, N> vectors = eigen.vectors;
  const Matrix<N, N> scaled = vectors * Vector<N>(eigen.values).cwiseMax(0).cwiseSqrt().asDiagonal();
  return scaled.lazyProduct(vectors.transpose());
}

/// Two combinations of the images of x + d and x - d under a map. `even`: half of the sum of the two images,
/// minus the image of the centre. `odd`: half of the difference of the two images. Both contain only the K
/// states that change.
template <int K>
struct Parts {
  Vector<K> even, odd;
};

/// `shift`: the mean of the K changed states minus the centre's image. `about_central`: the second moments of
/// all N states (rows, padded if N is odd) with the K changed states (columns), about the centre's image.
template <int N, int K>
struct Moments {
  Vector<K> shift;
  Matrix<even_rows(N), K> about_central;
};

/// The transform over the given columns of a root (padded if N is odd); parts(d) returns the Parts of the map
/// for an offset d.
template <int K, int N, int Columns, class PartsOf>
Moments<N, K> unscented_moments(const Matrix<even_rows(N), Columns>& root, double spread,
                                const PartsOf& parts) {
  Matrix<even_rows(N), Columns> odd = std::sqrt(spread) * root;
  Matrix<even_rows(K), Columns> even;
  if constexpr (K % 2 != 0) even.row(K).setZero();
  for (int j = 0; j < Columns; ++j) {
    const Parts<K> moved = parts(odd.col(j).template head<N>());
    even.col(j).template head<K>() = moved.even;
    odd.col(j).template head<K>() = moved.odd;
  }
  const double weight = 1 / spread;
  Moments<N, K> moments;
  moments.shift = weight * even.template topRows<K>().rowwise().sum();
  moments.about_central.noalias() = odd.lazyProduct(odd.template topRows<K>().transpose());
  moments.about_central.template topRows<even_rows(K)>().noalias() +=
      even.lazyProduct(even.template topRows<K>().transpose());
  moments.about_central *= weight;
  return moments;
}

}  // namespace canhil::filtering
