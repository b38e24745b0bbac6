#pragma once
// The sparse Jacobians of the filters as dense matrices.
#include "target/estimators/inflight_alignment/transition_product.hpp"

namespace canhil::inflight_alignment {

template <int N, int A>
Matrix<N, N> dense(const Transition<A>& G) {
  Matrix<N, N> out = Matrix<N, N>::Zero();
  alignas(16) const Matrix<N, N> identity = Matrix<N, N>::Identity();  // as FirstStates expects
  out.template topRows<6 + A>() = times_transposed<N, A>(FirstStates<N, A>(identity.data()), G).transpose();
  return out;
}

}  // namespace canhil::inflight_alignment
