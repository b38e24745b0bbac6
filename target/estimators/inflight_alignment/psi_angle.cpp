#include "target/estimators/inflight_alignment/psi_angle.hpp"

#include "target/estimators/inflight_alignment/psi_map.hpp"
#include "target/estimators/strapdown/attitude.hpp"

namespace canhil::inflight_alignment {

using Eigen::Matrix3d;
using Eigen::Vector3d;

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
  const PsiMap about(x.template head<15>(), interval);
  return moved<N>(x, interval, about.force_increment(), about.attitude_increment());
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
  errors.P = propagated<N, 3>(errors.P, G);
  errors.x = predicted<N>(errors.x, interval);
  add_process_noise<N>(errors.P, settings, interval.duration, Matrix3d::Identity());
}

template Vector<15> predicted<15>(const Vector<15>&, const Interval&);
template Vector<18> predicted<18>(const Vector<18>&, const Interval&);
template Transition<3> transition<15>(const Vector<15>&, const Interval&);
template Transition<3> transition<18>(const Vector<18>&, const Interval&);
template void predict_ekf<15>(Errors<15>&, const Interval&, const Settings&);
template void predict_ekf<18>(Errors<18>&, const Interval&, const Settings&);

}  // namespace canhil::inflight_alignment
