#include "target/estimators/transfer_alignment/considered.hpp"

#include <cmath>

#include "target/estimators/strapdown/attitude.hpp"

namespace canhil::transfer_alignment {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The sigmas of a sensor's matrix: the diagonal has scale factors, the rest misalignments.
Matrix3d matrix_sigma(double scale_factor, double misalignment) {
  Matrix3d sigma = Matrix3d::Constant(misalignment);
  sigma.diagonal().setConstant(scale_factor);
  return sigma;
}

// Adds the errors C M x dt of a sensor's matrix M with the sigmas `sigma` to the states from `state` on, for
// the mean attitude C and the measured increment x dt: the covariance of the state with q = M(i, j)/sigma(i,
// j) is C(:, i) (x dt)(j) sigma(i, j).
template <int state, int first>
void add_matrix_errors(Covariance& P, Sensitivity& S, const Matrix3d& C, const Vector3d& increment,
                       const Matrix3d& sigma) {
  Eigen::Matrix<double, 3, 9> B;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) B.col(3 * j + i) = C.col(i) * (increment(j) * sigma(i, j));
  // S has been propagated to T. P += T B' + B T' + B B'.
  const Eigen::Matrix<double, state_count, 3> TB = S.middleCols<9>(first).lazyProduct(B.transpose());
  P.middleCols<3>(state) += TB;
  P.middleRows<3>(state) += TB.transpose();
  P.block<3, 3>(state, state) += B.lazyProduct(B.transpose());
  S.block<3, 9>(state, first) += B;
}

// The innovation's partial derivative with respect to q.
Eigen::Matrix<double, 3, considered_count> innovation_by_q(const Sensitivity& S, const DifferenceOf& H) {
  Eigen::Matrix<double, 3, considered_count> by_q = S.middleRows<3>(velocity_state);
  by_q.rightCols<6>() += H;
  return by_q;
}

}  // namespace

bool considers(const Settings& settings) {
  return settings.accel_scale_factor_sigma > 0 || settings.accel_misalignment_sigma > 0 ||
         settings.gyro_scale_factor_sigma > 0 || settings.gyro_misalignment_sigma > 0 ||
         settings.lever_arm_sigma > 0 || settings.velocity_correlated_sigma > 0;
}

void predict_considered(Covariance& P, Sensitivity& S, const Covariance& G, const Interval& interval,
                        const Measured& measured, const Settings& settings) {
  S.rightCols<3>() *= std::exp(-interval.duration / settings.velocity_correlation_s);
  const Eigen::Matrix<double, 6, considered_count> GS = [&] {
    Eigen::Matrix<double, 6, considered_count> product;
    product.topRows<3>() = G.topLeftCorner<3, 9>().lazyProduct(S.topRows<9>());
    product.bottomRows<3>() =
        G.block<3, 3>(attitude_state, attitude_state).lazyProduct(S.middleRows<3>(attitude_state)) +
        G.block<3, 3>(attitude_state, gyro_bias_state).lazyProduct(S.middleRows<3>(gyro_bias_state));
    return product;
  }();
  S.topRows<6>() += GS;
  const Matrix3d C = interval.C_bn_integral / interval.duration;
  add_matrix_errors<velocity_state, accel_matrix>(
      P, S, C, measured.delta_v,
      matrix_sigma(settings.accel_scale_factor_sigma, settings.accel_misalignment_sigma));
  add_matrix_errors<attitude_state, gyro_matrix>(
      P, S, -C, measured.delta_theta,
      matrix_sigma(settings.gyro_scale_factor_sigma, settings.gyro_misalignment_sigma));
}

DifferenceOf difference_of(const Matrix3d& C_bn, const Vector3d& omega_ib_b, const Settings& settings) {
  DifferenceOf H;
  H.leftCols<3>() = settings.lever_arm_sigma * (C_bn * strapdown::skew(omega_ib_b));
  H.rightCols<3>() = -settings.velocity_correlated_sigma * Matrix3d::Identity();
  return H;
}

filtering::Correction<state_count, 3> update_considered(const Covariance& P, const Sensitivity& S,
                                                        const DifferenceOf& H, const Matrix3d& R,
                                                        const Vector3d& innovation) {
  filtering::Correction<state_count, 3> c;
  const Eigen::Matrix<double, state_count, 3> SHt = S.rightCols<6>().lazyProduct(H.transpose());
  const Eigen::Matrix<double, state_count, 3> PHt = P.middleCols<3>(velocity_state) + SHt;
  const Matrix3d from_q = SHt.middleRows<3>(velocity_state);
  c.S = PHt.middleRows<3>(velocity_state) + from_q.transpose() + H.lazyProduct(H.transpose()) + R;
  Matrix3d S_inverse;
  c.positive_definite = filtering::invert_positive_definite<3>(c.S, S_inverse);
  if (!c.positive_definite) return c;
  c.K.noalias() = PHt.lazyProduct(S_inverse);
  c.dx.noalias() = c.K.lazyProduct(innovation);
  c.nis = innovation.dot(S_inverse * innovation);
  c.P = P;
  c.P.noalias() -= c.K.lazyProduct(PHt.transpose());
  filtering::average_with_transpose<state_count>(c.P);
  return c;
}

Vector3d considered_share(const Sensitivity& S, const DifferenceOf& H, const Matrix3d& innovation) {
  return innovation_by_q(S, H).rowwise().squaredNorm().cwiseQuotient(innovation.diagonal());
}

void correct_considered(Sensitivity& S, const Eigen::Matrix<double, state_count, 3>& K,
                        const DifferenceOf& H) {
  S.noalias() -= K.lazyProduct(innovation_by_q(S, H));
}

}  // namespace canhil::transfer_alignment
