#include <type_traits>

#include "target/estimators/filtering/block_transition.hpp"
#include "target/estimators/inflight_alignment/transition_product.hpp"

namespace canhil::inflight_alignment {

template <int N, int A>
Matrix<N, N> propagated(const Matrix<N, N>& P, const Transition<A>& G) {
  return filtering::propagate_covariance_moving<6 + A, N>(P, [&G](const auto& M) {
    constexpr int rows = std::decay_t<decltype(M)>::RowsAtCompileTime;
    return times_transposed<rows, A>(FirstStates<rows, A>(M.data()), G);
  });
}

template Matrix<15, 15> propagated<15, 3>(const Matrix<15, 15>&, const Transition<3>&);
template Matrix<18, 18> propagated<18, 3>(const Matrix<18, 18>&, const Transition<3>&);
template Matrix<16, 16> propagated<16, 4>(const Matrix<16, 16>&, const Transition<4>&);
template Matrix<19, 19> propagated<19, 4>(const Matrix<19, 19>&, const Transition<4>&);

}  // namespace canhil::inflight_alignment
