#pragma once
// The unscented transform (Julier, Uhlmann 2004) of a map of which only the first K of N states move and the
// others keep their value. Sigma points x, x +- sqrt(spread) columns of a root of P, weights 1/(2 spread)
// each and the rest on the centre. In differences to the centre's image the centre drops out, and a pair of
// points enters by its even and odd part.
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

/// Half the sum and half the difference of a map's images of x + d and x - d, less the centre's image in the
/// sum; of the K states that move.
template <int K>
struct Parts {
  Vector<K> even, odd;
};

/// Moments of the moved states: mean less the centre's image; second moment about the centre's image, with
/// the states that stay below (all N rows, padded where N is odd).
template <int N, int K>
struct Moments {
  Vector<K> shift;
  Matrix<even_rows(N), K> about_central;
};

/// The transform over the given columns of a root (padded where N is odd); parts(d) gives the Parts of the
/// map for an offset d.
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
