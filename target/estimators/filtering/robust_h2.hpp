#pragma once
// Robust H2 filtering for an uncertain A + L Delta N, |Delta| <= 1 (Yang, Shim, Park 2001, after eq. (16)).
// With Phi = I + (A + P N'N/beta) dt the Riccati equation has two more terms, 2 P N'N P/beta and beta L L'.
// For any beta > 0, the sum of these two terms is an upper bound of the effect of the uncertainty.
#include <Eigen/Core>
#include <cmath>

#include "target/estimators/filtering/kalman.hpp"
#include "target/estimators/filtering/symmetric_eigen.hpp"

namespace canhil::filtering {

/// beta = sqrt(2 lmax(P N'N P) / lmax(L L')), which minimises 2 lmax(P N'N P)/beta + beta lmax(L L'); 0 if
/// one of these eigenvalues is zero or beta overflows. The two terms are then undefined and must be omitted.
inline double h2_beta(double lambda_PNNP, double lambda_LL) {
  const double beta = std::sqrt(2 * lambda_PNNP / lambda_LL);
  const bool usable = lambda_PNNP > 0 && lambda_LL > 0 && std::isnormal(beta) && std::isnormal(1 / beta);
  return usable ? beta : 0;
}

/// One Euler step of the H2 Riccati equation over dt: Phi = I + (A + P N'N / beta) dt, P+ = Phi P Phi' +
/// (beta L L' + Q) dt. A, Q [N x N], L [N x p], N_matrix [q x N]; beta = 0 gives the Kalman filter's step.
template <int N, int p, int q>
Matrix<N, N> propagate_h2(const Matrix<N, N>& P, const Matrix<N, N>& A, const Matrix<N, N>& Q,
                          const Matrix<N, p>& L, const Matrix<q, N>& N_matrix, double beta, double dt) {
  Matrix<N, N> Phi = Matrix<N, N>::Identity() + A * dt;
  Matrix<N, N> Qd = Q * dt;
  if (beta > 0) {
    const Matrix<N, q> PNt = P.lazyProduct(N_matrix.transpose());
    Phi.noalias() += (dt / beta) * PNt.lazyProduct(N_matrix);
    Qd.noalias() += (beta * dt) * L.lazyProduct(L.transpose());
  }
  return propagate_covariance<N>(P, Phi, Qd);
}

}  // namespace canhil::filtering
