#include "target/estimators/wind/correction.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "target/estimators/filtering/robust_h2.hpp"

namespace canhil::wind {
namespace {

using Matrix6 = filtering::Matrix<6, 6>;

// Updates by one scalar measurement h x, which is element `index` of the observation. The caller provides
// Ph = P h', S = h P h' + R and residual = innovation - h dx.
void absorb(Correction& c, int index, const StateVector& Ph, double S, double residual) {
  const double scale = 1 / std::sqrt(S);
  const StateVector q = scale * Ph;  // the factors of q q' are the same vector, so P stays exactly symmetric
  const double normalised = scale * residual;
  c.P.noalias() -= q.lazyProduct(q.transpose());
  c.dx += normalised * q;
  c.normalised(index) = normalised;
  c.nis += normalised * normalised;
  c.determinant *= S;
}

}  // namespace

Correction corrected(const Covariance& P, const Observation& innovation, const GroundVelocity& at,
                     const Observation& noise_variance, Sensitivity* sensitivity,
                     const LastingErrors& sigma) {
  Correction c;
  c.P = P;
  // `by`: minus the derivative of the residual with respect to the lasting errors.
  const auto absorb_sensitivity = [&](int index, const StateVector& Ph, double S, const LastingErrors& by) {
    c.lasting(index) = by.cwiseProduct(sigma).squaredNorm() / S;
    sensitivity->noalias() -= ((1 / S) * Ph).lazyProduct(by);
  };
  for (int i = 3; i < 9; ++i) {  // rates and Euler angles are states themselves
    const StateVector Ph = c.P.col(i);
    const double S = Ph(i) + noise_variance(i);
    absorb(c, i, Ph, S, innovation(i) - c.dx(i));
    if (sensitivity == nullptr) continue;
    LastingErrors by = sensitivity->row(i);
    if (i >= attitude_at) by(attitude_bias_at + i - attitude_at) -= 1;
    absorb_sensitivity(i, Ph, S, by);
  }
  for (int i = 0; i < 3; ++i) {  // ground velocity: row i of [C_bn 0 d(C_bn v_a)/dPhi I]
    const auto by_v_a = at.C_bn.row(i).transpose();
    const auto by_attitude = at.by_attitude.row(i).transpose();
    const auto times_h = [&](const StateVector& x) {
      return by_v_a.dot(x.segment<3>(air_velocity_at)) + by_attitude.dot(x.segment<3>(attitude_at)) +
             x(wind_at + i);
    };
    StateVector Ph = c.P.col(wind_at + i);
    Ph.noalias() += c.P.middleCols<3>(air_velocity_at).lazyProduct(by_v_a);
    Ph.noalias() += c.P.middleCols<3>(attitude_at).lazyProduct(by_attitude);
    const double S = times_h(Ph) + noise_variance(i);
    absorb(c, i, Ph, S, innovation(i) - times_h(c.dx));
    if (sensitivity == nullptr) continue;
    LastingErrors by = sensitivity->row(wind_at + i);
    by += by_v_a.transpose().lazyProduct(sensitivity->middleRows<3>(air_velocity_at));
    by += by_attitude.transpose().lazyProduct(sensitivity->middleRows<3>(attitude_at));
    by(velocity_bias_at + i) -= 1;
    absorb_sensitivity(i, Ph, S, by);
  }
  return c;
}

double capped_theta(double theta, double cap, const Covariance& P, double rate_weight) {
  if (!(theta > 0)) return 0;
  filtering::Vector<6> root_S;
  root_S << 1, 1, 1, filtering::Vector<3>::Constant(std::sqrt(rate_weight));
  const Matrix6 B = root_S.asDiagonal() * P.topLeftCorner<6, 6>() * root_S.asDiagonal();
  // A Cholesky factor of (cap/theta) I - B exists if and only if theta lambda_max < cap, so eigenvalues need
  // only be computed if theta must be lowered.
  const Matrix6 margin = (cap / theta) * Matrix6::Identity() - B;
  if (Eigen::LLT<Matrix6>(margin).info() == Eigen::Success) return theta;
  return cap / filtering::largest_eigenvalue<6>(B);
}

void inflate(Correction& c, double theta, double rate_weight) {
  for (int j = 0; j < 6; ++j) {
    const double weight = theta * (j < 3 ? 1 : rate_weight);
    if (!(weight > 0)) continue;
    // A scalar update with the negative noise variance -1/weight: S = P_jj - 1/weight is negative, so the
    // square root of -S is used.
    const StateVector p = c.P.col(j);
    const double scale = 1 / std::sqrt(1 / weight - p(j));
    const StateVector q = scale * p;
    const double pulled = scale * c.dx(j);
    c.P.noalias() += q.lazyProduct(q.transpose());
    c.dx += pulled * q;
  }
}

}  // namespace canhil::wind
