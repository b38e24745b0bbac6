#pragma once
// The filters' sparse Jacobians as the matrices they stand for.
#include "target/estimators/inflight_alignment/error_model.hpp"

namespace canhil::inflight_alignment {

template <int N, int A>
Matrix<N, N> dense(const Transition<A>& G) {
  Matrix<N, N> out = Matrix<N, N>::Zero();
  out.template topRows<6 + A>() = times_transposed<N, N, A>(Matrix<N, N>::Identity(), G).transpose();
  return out;
}

}  // namespace canhil::inflight_alignment
