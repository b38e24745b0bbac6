#pragma once
// Robust H2 filtering for a system matrix A + L Delta N with an unknown Delta, |Delta| <= 1 (Yang, Shim, Park
// 2001, after eq. (16)). The Riccati equation has two terms more than that of the Kalman filter:
// 2 P N'N P/beta, which comes from Phi = I + (A + P N'N/beta) dt, and beta L L'. For any beta > 0, the sum of
// these two terms is an upper bound of the effect of the uncertainty.
#include <Eigen/Core>
#include <cmath>

#include "target/estimators/filtering/kalman.hpp"
#include "target/estimators/filtering/symmetric_eigen.hpp"

namespace canhil::filtering {

/// beta = sqrt(2 lmax(P N'N P) / lmax(L L')), where lmax is the largest eigenvalue. This beta minimises
/// 2 lmax(P N'N P)/beta + beta lmax(L L'). Returns 0 if one of the two eigenvalues is zero, or if beta or
/// 1/beta is not a normal number; the two H2 terms must then be omitted.
inline double h2_beta(double lambda_PNNP, double lambda_LL) {
  const double beta = std::sqrt(2 * lambda_PNNP / lambda_LL);
  const bool usable = lambda_PNNP > 0 && lambda_LL > 0 && std::isnormal(beta) && std::isnormal(1 / beta);
  return usable ? beta : 0;
}

/// One Euler step of the H2 Riccati equation over dt: Phi = I + (A + P N'N / beta) dt,
/// P+ = Phi P Phi' + (beta L L' + Q) dt. A and Q are [N x N], L is [N x p], N_matrix is [q x N]. If beta is
/// 0, the step has no H2 terms and is that of the Kalman filter.
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
