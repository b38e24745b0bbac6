#include "target/estimators/inflight_alignment/sin_cos.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "target/estimators/strapdown/attitude.hpp"

namespace canhil::inflight_alignment {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int sine = 8, cosine = 9;       // states s and k
constexpr double smallest_radius = 0.01;  // least |(s, 1 - k)|, which is near 0 for an unknown heading
constexpr double circle_tolerance = 0.4;  // largest | |(s, 1 - k)| - 1 | of a resolved heading

// sin and cos of the heading error, and the interval's quantities after rotation by the heading error.
struct Turned {
  double s, c;
  Vector3d force;  // Rz S
  Vector3d wT;     // Rz (w_ie + w_en) T
  Matrix3d A;      // published: Rz A, for biases b; levelled: Rz A Rz', for b' = Rz b

  template <int N>
  Turned(const Errors<N>& errors, const Interval& interval)
      : s(std::sin(heading_error<N>(errors.x))), c(std::cos(heading_error<N>(errors.x))) {
    Matrix3d Rz;
    Rz << c, -s, 0, s, c, 0, 0, 0, 1;
    force = Rz * interval.delta_v_n;
    wT = Rz * (interval.omega_ie_n + interval.omega_en_n) * interval.duration;
    A = Rz * interval.C_bn_integral;
    if (errors.form == SinCosForm::levelled) A = (A * Rz.transpose()).eval();
  }
};

// Returns H, the second derivative of the vertical force with respect to a = (phi_x, phi_y, s, k). The
// vertical force minus S_z is (phi x Rz S)_z - phi^2 S_z / 2, which equals
// S_y phi_x - S_x phi_y + a' H a / 2. The horizontal force, Rz S + phi x (S_z e_z), is linear in a.
Matrix<4, 4> curvature(const Vector3d& S) {
  Matrix<4, 4> H;
  H << -S.z(), 0, S.x(), -S.y(),  //
      0, -S.z(), S.y(), S.x(),    //
      S.x(), S.y(), 0, 0,         //
      -S.y(), S.x(), 0, 0;
  return H;
}

// Adds the errors of the increments that bridge lost samples.
template <int N>
void add_bridging_noise(Errors<N>& errors, const Interval& interval, double psi) {
  using At = Layout<N>;
  const Matrix3d Rz = strapdown::exp_rotation({0, 0, psi});
  const Matrix3d velocity = Rz * root_in_n(interval, interval.delta_v_variance);
  const Matrix3d angle = Rz * root_in_n(interval, interval.delta_theta_variance);
  Matrix<4, 3> attitude;  // of the tilts, s and k
  attitude << angle.topRows<2>(), std::cos(psi) * angle.row(2), std::sin(psi) * angle.row(2);
  errors.P.template block<3, 3>(At::velocity, At::velocity) += velocity * velocity.transpose();
  errors.P.template block<4, 4>(At::attitude, At::attitude) += attitude * attitude.transpose();
}

template <int N>
Matrix<4, 4> attitude_covariance(const Errors<N>& errors) {
  return errors.P.template block<4, 4>(6, 6);
}

// Maps P to new attitude states a_new = J a.
template <int N>
void map_attitude(Errors<N>& errors, const Matrix<4, 4>& J) {
  Matrix<N, N>& P = errors.P;
  P.template middleRows<4>(6) = (J * P.template middleRows<4>(6)).eval();
  P.template middleCols<4>(6) = (P.template middleCols<4>(6) * J.transpose()).eval();
  filtering::average_with_transpose<N>(P);
}

}  // namespace

template <int N>
double heading_error(const Vector<N>& x) {
  return std::atan2(x(sine), 1 - x(cosine));
}

template <int N>
Matrix3d tilt_and_heading(const Vector<N>& x) {
  return strapdown::exp_rotation({x(6), x(7), 0}) * strapdown::exp_rotation({0, 0, heading_error<N>(x)});
}

template <int N>
Matrix<3, 4> angles_of_states(const Vector<N>& x) {
  const double psi = heading_error<N>(x);
  const double radius = std::max(std::hypot(x(sine), 1 - x(cosine)), smallest_radius);
  Matrix<3, 4> J;
  J << 1, 0, 0, 0,  //
      0, 1, 0, 0,   //
      0, 0, std::cos(psi) / radius, std::sin(psi) / radius;
  return J;
}

template <int N>
void set_heading_prior(Errors<N>& errors, double sigma) {
  const double half = std::exp(-sigma * sigma / 2);
  errors.x(sine) = 0;
  errors.x(cosine) = 1 - half;
  errors.P(sine, sine) = (1 - half * half * half * half) / 2;
  errors.P(cosine, cosine) = (1 - half * half) * (1 - half * half) / 2;
  errors.P(sine, cosine) = errors.P(cosine, sine) = 0;
}

template <int N>
Vector<N> predicted_sin_cos(const Errors<N>& errors, const Interval& interval) {
  using At = Layout<N>;
  const Vector<N>& x = errors.x;
  const Turned turned(errors, interval);
  const double s = x(sine), k = x(cosine);
  const Vector3d phi(x(6), x(7), 0);
  const Vector3d& S = interval.delta_v_n;
  const Vector3d wT = (interval.omega_ie_n + interval.omega_en_n) * interval.duration;
  const Vector3d drift = turned.A * x.template segment<3>(At::gyro_bias);
  Vector3d force = Vector3d(k * S.x() + s * S.y(), k * S.y() - s * S.x(), 0) - phi.cross(turned.force);
  if (errors.form == SinCosForm::levelled) {
    const Vector<4> a = x.template segment<4>(6);
    const Matrix<4, 4> H = curvature(S);
    const double mean_square = a.dot(H * a) + H.cwiseProduct(attitude_covariance<N>(errors)).sum();
    force.z() = S.x() * a(1) - S.y() * a(0) - mean_square / 2;
  }
  force += turned.A * x.template segment<3>(At::accel_bias);
  const Vector3d tilted = phi.cross(turned.wT);
  const double turn = turned.wT.y() * phi.x() - turned.wT.x() * phi.y() - drift.z();
  const Vector<4> attitude(tilted.x() - k * wT.x() - s * wT.y() - drift.x(),
                           tilted.y() - k * wT.y() + s * wT.x() - drift.y(), turned.c * turn,
                           turned.s * turn);
  return moved<N>(x, interval, force, attitude);
}

template <int N>
Transition<4> transition_sin_cos(const Errors<N>& errors, const Interval& interval) {
  const Turned turned(errors, interval);
  const Vector3d& S = interval.delta_v_n;
  const Vector3d& f = turned.force;
  const Vector3d& t = turned.wT;
  const Vector3d wT = (interval.omega_ie_n + interval.omega_en_n) * interval.duration;
  Transition<4> G = kinematic_transition<4>(interval);
  G.velocity_attitude << 0, -f.z(), S.y(), S.x(),  // columns: f x e_x, f x e_y, s, k
      f.z(), 0, -S.x(), S.y(),                     //
      -f.y(), f.x(), 0, 0;
  if (errors.form == SinCosForm::levelled) {
    const Vector<4> a = errors.x.template segment<4>(6);
    G.velocity_attitude.row(2) = -(Vector<4>(S.y(), -S.x(), 0, 0) + curvature(S) * a).transpose();
  }
  G.velocity_accel = turned.A;
  const Eigen::RowVector2d turn(t.y(), -t.x());
  G.attitude_attitude << 0, t.z(), -wT.y(), -wT.x(),  //
      -t.z(), 0, wT.x(), -wT.y(),                     //
      turned.c * turn, 0, 0,                          //
      turned.s * turn, 0, 0;
  G.attitude_gyro << -turned.A.topRows<2>(), -turned.c * turned.A.row(2), -turned.s * turned.A.row(2);
  return G;
}

template <int N>
void predict_sin_cos(Errors<N>& errors, const Interval& interval, const Settings& settings) {
  const Transition<4> G = transition_sin_cos<N>(errors, interval);
  const double psi = heading_error<N>(errors.x);
  const Vector<4> heading(0, 0, std::cos(psi), std::sin(psi));
  Matrix<4, 4> shape = heading * heading.transpose();
  shape(0, 0) = shape(1, 1) = 1;
  double second_order = 0;  // variance of a' H a / 2 about its mean
  if (errors.form == SinCosForm::levelled) {
    const Matrix<4, 4> HP = curvature(interval.delta_v_n) * attitude_covariance<N>(errors);
    // The tilt, and so this term, hardly changes until a fix: its sigmas add up, not its variances. The term
    // is chi-squared, with a longer tail than a normal error of its sigma: with tilts of 5 deg one of 600
    // runs was beyond 5 sigma in the first seconds. Twice the sigma covers the tail.
    constexpr double tail = 2;
    const double sigma = tail * std::sqrt(std::max(0.0, HP.cwiseProduct(HP.transpose()).sum() / 2));
    second_order = sigma * (sigma + 2 * errors.second_order);
    errors.second_order += sigma;
  }
  errors.x = predicted_sin_cos<N>(errors, interval);
  errors.P = propagated<N, 4>(errors.P, G);
  add_process_noise<N>(errors.P, settings, interval.duration, shape);
  errors.P(5, 5) += second_order;
  if (errors.form == SinCosForm::levelled) add_bridging_noise<N>(errors, interval, psi);
}

template <int N>
bool heading_is_resolved(const Errors<N>& errors, const Settings& settings) {
  const Vector<4> J = angles_of_states<N>(errors.x).row(2).transpose();
  const double variance = J.dot(attitude_covariance<N>(errors) * J);
  const double off_circle = std::abs(std::hypot(errors.x(sine), 1 - errors.x(cosine)) - 1);
  return variance < settings.handover_sigma * settings.handover_sigma && off_circle < circle_tolerance;
}

template <int N>
bool is_off_circle(const Errors<N>& errors, bool was) {
  constexpr double begins = 4, ends = 2, tolerance = 0.05;
  const Vector<2> point(errors.x(sine), 1 - errors.x(cosine));
  const Vector<2> outward = Vector<2>(point.x(), -point.y()) / point.norm();
  const double variance = outward.dot(errors.P.template block<2, 2>(sine, sine) * outward);
  return std::abs(point.norm() - 1) > (was ? ends : begins) * std::sqrt(variance) + tolerance;
}

template <int N>
Matrix3d axes_of_biases(const Errors<N>& errors) {
  const bool turned = errors.form == SinCosForm::levelled;
  return strapdown::exp_rotation({0, 0, turned ? -heading_error<N>(errors.x) : 0});
}

template <int N>
void turn_biases_back(Errors<N>& errors) {
  if (errors.form == SinCosForm::published) return;
  using At = Layout<N>;
  const double psi = heading_error<N>(errors.x), c = std::cos(psi), s = std::sin(psi);
  const Matrix3d back = axes_of_biases<N>(errors);
  Vector<N>& x = errors.x;
  Matrix<N, N>& P = errors.P;
  for (const int at : {At::accel_bias, At::gyro_bias}) {
    const Vector3d turn(-x(at + 1), x(at), 0);  // e_z x b'
    P.template middleRows<3>(at) -= turn * (c * P.row(sine) + s * P.row(cosine));
    P.template middleRows<3>(at) = (back * P.template middleRows<3>(at)).eval();
    P.template middleCols<3>(at) -= (c * P.col(sine) + s * P.col(cosine)) * turn.transpose();
    P.template middleCols<3>(at) = (P.template middleCols<3>(at) * back.transpose()).eval();
    x.template segment<3>(at) = (back * x.template segment<3>(at)).eval();
  }
}

template <int N>
Matrix3d take_out_tilt(Errors<N>& errors) {
  const Matrix<4, 4> P = attitude_covariance<N>(errors);
  Vector<N>& x = errors.x;
  const double s = x(sine), c = 1 - x(cosine);
  const double square = s * s + c * c + P(2, 2) + P(3, 3);
  const double north = (c * x(6) + s * x(7) + P(1, 2) - P(0, 3)) / square;
  const double east = (c * x(7) - s * x(6) - P(0, 2) - P(1, 3)) / square;
  x(6) -= c * north - s * east;
  x(7) -= c * east + s * north;
  Matrix<4, 4> J = Matrix<4, 4>::Identity();
  J.topRightCorner<2, 2>() << east, north, -north, east;
  map_attitude<N>(errors, J);
  return strapdown::exp_rotation({north, east, 0});
}

template <int N>
Matrix3d take_out_attitude(Errors<N>& errors) {
  Matrix3d C_pc = tilt_and_heading<N>(errors.x);
  const double psi = heading_error<N>(errors.x);
  Matrix<4, 4> J = Matrix<4, 4>::Zero();
  J.topLeftCorner<2, 2>().setIdentity();
  J.row(2) << 0, 0, std::cos(psi), std::sin(psi);  // dpsi
  if (errors.form == SinCosForm::levelled) {
    J.row(0) += errors.x(7) * J.row(2);
    J.row(1) -= errors.x(6) * J.row(2);
  }
  turn_biases_back<N>(errors);
  map_attitude<N>(errors, J);
  errors.x.template segment<4>(6).setZero();
  return C_pc;
}

#define CANHIL_INSTANTIATE(N)                                                      \
  template double heading_error<N>(const Vector<N>&);                              \
  template Matrix3d tilt_and_heading<N>(const Vector<N>&);                         \
  template Matrix<3, 4> angles_of_states<N>(const Vector<N>&);                     \
  template void set_heading_prior<N>(Errors<N>&, double);                          \
  template Vector<N> predicted_sin_cos<N>(const Errors<N>&, const Interval&);      \
  template Transition<4> transition_sin_cos<N>(const Errors<N>&, const Interval&); \
  template void predict_sin_cos<N>(Errors<N>&, const Interval&, const Settings&);  \
  template bool heading_is_resolved<N>(const Errors<N>&, const Settings&);         \
  template bool is_off_circle<N>(const Errors<N>&, bool);                          \
  template Matrix3d axes_of_biases<N>(const Errors<N>&);                           \
  template void turn_biases_back<N>(Errors<N>&);                                   \
  template Matrix3d take_out_tilt<N>(Errors<N>&);                                  \
  template Matrix3d take_out_attitude<N>(Errors<N>&);
CANHIL_INSTANTIATE(16)
CANHIL_INSTANTIATE(19)
#undef CANHIL_INSTANTIATE

}  // namespace canhil::inflight_alignment
