#include "target/estimators/inflight_alignment/psi_angle.hpp"

#include <cmath>
#include <type_traits>

#include "target/estimators/filtering/block_transition.hpp"
#include "target/estimators/filtering/positive_definite.hpp"
#include "target/estimators/filtering/unscented.hpp"
#include "target/estimators/strapdown/attitude.hpp"

namespace canhil::inflight_alignment {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double spread = 3;  // N + kappa

struct Trig {
  Vector3d sin, cos;  // of psi_x, psi_y, psi_z

  explicit Trig(const Vector3d& psi)
      : sin(std::sin(psi.x()), std::sin(psi.y()), std::sin(psi.z())),
        cos(std::cos(psi.x()), std::cos(psi.y()), std::cos(psi.z())) {}
  Trig(const Vector3d& sine, const Vector3d& cosine) : sin(sine), cos(cosine) {}
};

Trig sum(const Trig& a, const Trig& b) {
  return {a.sin.cwiseProduct(b.cos) + a.cos.cwiseProduct(b.sin),
          a.cos.cwiseProduct(b.cos) - a.sin.cwiseProduct(b.sin)};
}
Trig difference(const Trig& a, const Trig& b) {
  return {a.sin.cwiseProduct(b.cos) - a.cos.cwiseProduct(b.sin),
          a.cos.cwiseProduct(b.cos) + a.sin.cwiseProduct(b.sin)};
}

Matrix3d rotation(const Trig& t) {
  const double sx = t.sin.x(), sy = t.sin.y(), sz = t.sin.z();
  const double cx = t.cos.x(), cy = t.cos.y(), cz = t.cos.z();
  Matrix3d C;
  C << cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx,  //
      sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx,   //
      -sy, cy * sx, cy * cx;
  return C;
}

// E(psi) rate: Euler angle rates of Rz Ry Rx from the rotation rate in p.
Vector3d euler_rates(const Trig& t, const Vector3d& rate) {
  const double across = (t.sin.x() * rate.y() + t.cos.x() * rate.z()) / t.cos.y();
  return {rate.x() + across * t.sin.y(), t.cos.x() * rate.y() - t.sin.x() * rate.z(), across};
}

Matrix3d euler_rate_matrix(const Trig& t) {
  Matrix3d E;
  E << euler_rates(t, Vector3d::UnitX()), euler_rates(t, Vector3d::UnitY()),
      euler_rates(t, Vector3d::UnitZ());
  return E;
}

// The interval's terms of the model that depend on psi and on the biases.
struct Terms {
  Vector3d force;  // C_pc (S - A n)
  Vector3d rates;  // E [(w - C_pc' w) T - A e]
};

struct Model {
  const Interval& interval;
  Vector3d wT;  // (w_ie + w_en) T

  explicit Model(const Interval& over)
      : interval(over), wT((over.omega_ie_n + over.omega_en_n) * over.duration) {}

  // true_force = S - A n, drift = A e
  [[nodiscard]] Terms operator()(const Trig& t, const Vector3d& true_force, const Vector3d& drift) const {
    const Matrix3d C = rotation(t);
    return {C * true_force, euler_rates(t, wT - C.transpose() * wT - drift)};
  }
};

// The map about x: x's own image, the even and odd parts of x +- d, and its Jacobian with respect to the
// biases.
template <int N>
class Centre {
 public:
  using At = Layout<N>;

  Centre(const Vector<N>& x, const Interval& interval)
      : model_(interval),
        trig_(Vector3d(x.template segment<3>(At::attitude))),
        true_force_(interval.delta_v_n - interval.C_bn_integral * x.template segment<3>(At::accel_bias)),
        drift_(interval.C_bn_integral * x.template segment<3>(At::gyro_bias)),
        terms_(model_(trig_, true_force_, drift_)),
        coriolis_(2 * interval.omega_ie_n + interval.omega_en_n) {}

  [[nodiscard]] Vector<N> image(const Vector<N>& x) const {
    return moved<N>(x, model_.interval, model_.interval.delta_v_n - terms_.force, terms_.rates);
  }

  // sin and cos of both points come from one set of them.
  filtering::Parts<9> operator()(const Vector<N>& d) const {
    const Interval& interval = model_.interval;
    const double T = interval.duration;
    const Vector3d R = d.template segment<3>(At::position), V = d.template segment<3>(At::velocity);
    const Vector3d psi = d.template segment<3>(At::attitude);
    const Vector3d force = interval.C_bn_integral * d.template segment<3>(At::accel_bias);
    const Vector3d drift = interval.C_bn_integral * d.template segment<3>(At::gyro_bias);
    const Trig turn(psi);
    const Terms plus = model_(sum(trig_, turn), true_force_ - force, drift_ + drift);
    const Terms minus = model_(difference(trig_, turn), true_force_ + force, drift_ - drift);

    const Vector3d odd_dV =
        T * (gravity_error_per_m().cwiseProduct(R) - coriolis_.cross(V)) - 0.5 * (plus.force - minus.force);
    const Vector3d even_dV = terms_.force - 0.5 * (plus.force + minus.force);
    filtering::Parts<9> parts;
    parts.odd.template segment<3>(At::position) = R + T * (V + 0.5 * odd_dV - interval.omega_en_n.cross(R));
    parts.odd.template segment<3>(At::velocity) = V + odd_dV;
    parts.odd.template segment<3>(At::attitude) = psi + 0.5 * (plus.rates - minus.rates);
    parts.even.template segment<3>(At::position) = (0.5 * T) * even_dV;
    parts.even.template segment<3>(At::velocity) = even_dV;
    parts.even.template segment<3>(At::attitude) = 0.5 * (plus.rates + minus.rates) - terms_.rates;
    return parts;
  }

  // The lower root's columns beyond psi move biases alone, and for a given psi the map is linear in them:
  // what those points would add is G_c rest, and G_c rest G_c'.
  void add_points_of_biases(filtering::Moments<N, 9>& moments, const Matrix<N - 9, N - 9>& rest) const {
    const Matrix3d& A = model_.interval.C_bn_integral;
    const Matrix3d velocity_accel = rotation(trig_) * A;
    const Matrix3d attitude_gyro = -euler_rate_matrix(trig_) * A;
    const double half = model_.interval.duration / 2;
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

 private:
  Model model_;
  Trig trig_;
  Vector3d true_force_, drift_;
  Terms terms_;
  Vector3d coriolis_;
};

// Moments over the whole root's sigma points, the lower one's columns beyond psi in closed form; counts the
// repairs that P needed.
template <int N>
filtering::Moments<N, 9> moments_about(const Centre<N>& centre, Matrix<N, N>& P, UkfRoot kind, int& repairs) {
  if (kind == UkfRoot::symmetric) {
    repairs += filtering::repair<N>(P) ? 1 : 0;
    return filtering::unscented_moments<9, N>(filtering::padded(filtering::symmetric_root<N>(P)), spread,
                                              centre);
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
  auto moments = filtering::unscented_moments<9, N>(root, spread, centre);
  centre.add_points_of_biases(moments, rest);
  return moments;
}

}  // namespace

Matrix3d platform_to_computer(const Vector3d& psi) { return rotation(Trig(psi)); }

Matrix3d rotation_axes(const Vector3d& psi) {
  const Trig t(psi);
  Matrix3d axes;
  axes << t.cos.z() * t.cos.y(), -t.sin.z(), 0,  //
      t.sin.z() * t.cos.y(), t.cos.z(), 0,       //
      -t.sin.y(), 0, 1;
  return axes;
}

template <int N>
Vector<N> predicted(const Vector<N>& x, const Interval& interval) {
  return Centre<N>(x, interval).image(x);
}

template <int N>
Transition<3> transition(const Vector<N>& x, const Interval& interval) {
  using At = Layout<N>;
  const Vector3d psi = x.template segment<3>(At::attitude);
  const Trig trig(psi);
  const Matrix3d C = rotation(trig), axes = rotation_axes(psi);
  const Matrix3d& A = interval.C_bn_integral;
  const Vector3d force = C * (interval.delta_v_n - A * x.template segment<3>(At::accel_bias));
  const Vector3d wT = (interval.omega_ie_n + interval.omega_en_n) * interval.duration;
  Transition<3> G = kinematic_transition<3>(interval);
  G.velocity_attitude = strapdown::skew(force) * axes;  // -a_i x force
  G.velocity_accel = C * A;
  G.attitude_attitude = -C.transpose() * strapdown::skew(wT) * axes;  // -d(C')/dpsi_i wT = C' (a_i x wT)
  G.attitude_gyro = -A;
  return G;
}

template <int N>
void predict_ekf(Errors<N>& errors, const Interval& interval, const Settings& settings) {
  const Transition<3> G = transition<N>(errors.x, interval);
  errors.P = filtering::propagate_covariance_moving<9, N>(errors.P, [&](const auto& M) {
    return times_transposed<N, std::decay_t<decltype(M)>::RowsAtCompileTime>(M, G);
  });
  errors.x = predicted<N>(errors.x, interval);
  add_process_noise<N>(errors.P, settings, interval.duration, Matrix3d::Identity());
}

template <int N>
int predict_ukf(Errors<N>& errors, const Interval& interval, const Settings& settings) {
  int repairs = 0;
  const Centre<N> centre(errors.x, interval);
  const auto moments = moments_about<N>(centre, errors.P, settings.ukf_root, repairs);
  errors.x = centre.image(errors.x);
  errors.x.template head<9>() += moments.shift;
  errors.P.template leftCols<9>() = moments.about_central.template topRows<N>();
  // The second moment about the mean is that about the centre's image less the shift's square, whatever the
  // centre's weight.
  if (settings.ukf_covariance == UkfCovariance::about_mean)
    errors.P.template topLeftCorner<9, 9>().noalias() -= moments.shift.lazyProduct(moments.shift.transpose());
  filtering::mirror_lower<N>(errors.P);
  add_process_noise<N>(errors.P, settings, interval.duration, Matrix3d::Identity());
  return repairs + (filtering::repair<N>(errors.P) ? 1 : 0);
}

template Vector<15> predicted<15>(const Vector<15>&, const Interval&);
template Vector<18> predicted<18>(const Vector<18>&, const Interval&);
template Transition<3> transition<15>(const Vector<15>&, const Interval&);
template Transition<3> transition<18>(const Vector<18>&, const Interval&);
template void predict_ekf<15>(Errors<15>&, const Interval&, const Settings&);
template void predict_ekf<18>(Errors<18>&, const Interval&, const Settings&);
template int predict_ukf<15>(Errors<15>&, const Interval&, const Settings&);
template int predict_ukf<18>(Errors<18>&, const Interval&, const Settings&);

}  // namespace canhil::inflight_alignment
