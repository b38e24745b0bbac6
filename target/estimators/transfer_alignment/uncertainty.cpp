#include "target/estimators/transfer_alignment/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "target/estimators/filtering/robust_h2.hpp"
#include "target/estimators/strapdown/attitude.hpp"

namespace canhil::transfer_alignment {

double uncertainty_size(const Settings& settings, const Covariance& P, const Eigen::Vector3d& f_n) {
  if (settings.alpha_rule == AlphaRule::constant) return settings.alpha_constant;
  // Not computed as tr(P) |f|^2 - f' P f, which loses all digits for a heading error in level flight, the
  // most important case.
  const Eigen::Matrix3d F = strapdown::skew(f_n);
  const double variance = (F * P.block<3, 3>(attitude_state, attitude_state)).cwiseProduct(F).sum();
  const double largest_angle = std::min(3 * settings.attitude_sigma_0.norm(), std::numbers::pi);
  const double cap = 2 * std::sin(largest_angle / 2) * f_n.norm();
  return std::min(std::sqrt(std::max(variance, 0.0)), cap);
}

Uncertainty uncertainty(H2Case h2_case, double alpha) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d S = strapdown::skew(Eigen::Vector3d::Ones());
  switch (h2_case) {
    case H2Case::one:
      return {alpha * I, I, alpha * alpha};
    case H2Case::two:
      return {alpha * S, I, 3 * alpha * alpha};
    case H2Case::three:
      return {I, alpha * S, 1};
    case H2Case::four:
      break;
  }
  return {I, alpha * I, 1};
}

double add_h2_terms(const Uncertainty& uncertain, const Covariance& P, double duration, Covariance& G,
                    Eigen::Matrix3d& Q_velocity) {
  // P N'N P has the eigenvalues of the 3 x 3 matrix N P P N', which needs all 12 rows of P's attitude
  // columns.
  const Eigen::Matrix<double, state_count, 3> PNt =
      P.middleCols<3>(attitude_state).lazyProduct(uncertain.N.transpose());
  const Eigen::Matrix3d NPPNt = PNt.transpose().lazyProduct(PNt);
  const double beta = filtering::h2_beta(filtering::largest_eigenvalue<3>(NPPNt), uncertain.lambda_LL);
  if (!(beta > 0)) return 0;
  G.middleCols<3>(attitude_state).noalias() += PNt.lazyProduct(uncertain.N * (duration / beta));
  Q_velocity += uncertain.L * uncertain.L.transpose() * (beta * duration);
  return beta;
}

}  // namespace canhil::transfer_alignment
