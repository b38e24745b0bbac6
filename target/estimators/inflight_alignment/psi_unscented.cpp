#include "target/estimators/filtering/positive_definite.hpp"
#include "target/estimators/filtering/unscented.hpp"
#include "target/estimators/inflight_alignment/psi_angle.hpp"
#include "target/estimators/inflight_alignment/psi_map.hpp"

namespace canhil::inflight_alignment {
namespace {

constexpr double spread = 3;  // N + kappa

// Adds, in closed form, the sigma points of those columns of the lower root that come after the columns of
// psi. These points differ from the centre only in the biases, and for a given psi the map is linear in the
// biases. Let `rest` be the covariance of these columns, and G_c the derivative of the map with respect to
// the biases. The points then add rest G_c' and G_c rest G_c' to the second moments.
template <int N>
void add_points_of_biases(const PsiMap& centre, filtering::Moments<N, 9>& moments,
                          const Matrix<N - 9, N - 9>& rest) {
  const Eigen::Matrix3d velocity_accel = centre.velocity_accel(), attitude_gyro = centre.attitude_gyro();
  const double half = centre.duration() / 2;
  Matrix<N - 9, 9> added;  // rest G_c'
  added.template middleCols<3>(3) = rest.template leftCols<3>().lazyProduct(velocity_accel.transpose());
  added.template leftCols<3>() = half * added.template middleCols<3>(3);
  added.template middleCols<3>(6) = rest.template middleCols<3>(3).lazyProduct(attitude_gyro.transpose());
  moments.about_central.template middleRows<N - 9>(9) += added;
  const Matrix<3, 9> velocity = velocity_accel.lazyProduct(added.template topRows<3>());
  moments.about_central.template topRows<3>() += half * velocity;
  moments.about_central.template middleRows<3>(3) += velocity;
  moments.about_central.template middleRows<3>(6) +=
      attitude_gyro.lazyProduct(added.template middleRows<3>(3));
}

// The moments over all sigma points; for a lower root, the columns after those of psi are added in closed
// form. Adds the number of repairs of P to `repairs`.
template <int N>
filtering::Moments<N, 9> moments_about(const PsiMap& centre, Matrix<N, N>& P, UkfRoot kind, int& repairs) {
  const auto parts = [&centre](const auto& d) { return centre.parts(d.template head<15>()); };
  if (kind == UkfRoot::symmetric) {
    repairs += filtering::repair<N>(P) ? 1 : 0;
    return filtering::unscented_moments<9, N>(filtering::padded(filtering::symmetric_root<N>(P)), spread,
                                              parts);
  }
  Matrix<filtering::even_rows(N), 9> root;
  Matrix<N - 9, N - 9> rest;
  const auto factor = [&] {
    if (!filtering::cholesky_columns<9, N>(P, root)) return false;
    rest = filtering::cholesky_rest<9, N>(P, root);
    return filtering::is_positive_definite<N - 9>(rest);
  };
  if (!factor()) {
    P = filtering::with_eigenvalue_floor<N>(P);
    ++repairs;
    factor();
  }
  auto moments = filtering::unscented_moments<9, N>(root, spread, parts);
  add_points_of_biases<N>(centre, moments, rest);
  return moments;
}

}  // namespace

template <int N>
int predict_ukf(Errors<N>& errors, const Interval& interval, const Settings& settings) {
  int repairs = 0;
  const PsiMap centre(errors.x.template head<15>(), interval);
  const auto moments = moments_about<N>(centre, errors.P, settings.ukf_root, repairs);
  errors.x = moved<N>(errors.x, interval, centre.force_increment(), centre.attitude_increment());
  errors.x.template head<9>() += moments.shift;
  errors.P.template leftCols<9>() = moments.about_central.template topRows<N>();
  // For any weight of the centre, the second moment about the mean equals the second moment about the image
  // of the centre, minus shift * shift^T.
  if (settings.ukf_covariance == UkfCovariance::about_mean)
    errors.P.template topLeftCorner<9, 9>().noalias() -= moments.shift.lazyProduct(moments.shift.transpose());
  filtering::mirror_lower<N>(errors.P);
  add_process_noise<N>(errors.P, settings, interval.duration, Eigen::Matrix3d::Identity());
  return repairs + (filtering::repair<N>(errors.P) ? 1 : 0);
}

template int predict_ukf<15>(Errors<15>&, const Interval&, const Settings&);
template int predict_ukf<18>(Errors<18>&, const Interval&, const Settings&);

}  // namespace canhil::inflight_alignment
