#include "target/estimators/inflight_alignment/error_model.hpp"

#include <Eigen/Geometry>

#include "target/estimators/strapdown/attitude.hpp"

namespace canhil::inflight_alignment {

using Eigen::Vector3d;
using strapdown::skew;

template <int A>
Transition<A> kinematic_transition(const Interval& interval) {
  Transition<A> G;
  G.T = interval.duration;
  G.transport = skew(-G.T * interval.omega_en_n);
  G.coriolis = skew(-G.T * (2 * interval.omega_ie_n + interval.omega_en_n));
  return G;
}

template <int N>
Vector<N> moved(const Vector<N>& x, const Interval& interval, const Vector3d& force_increment,
                const Vector<Layout<N>::attitude_count>& attitude_increment) {
  using At = Layout<N>;
  const double T = interval.duration;
  const Vector3d R = x.template segment<3>(At::position);
  const Vector3d V = x.template segment<3>(At::velocity);
  const Vector3d dV = force_increment + T * (gravity_error_per_m().cwiseProduct(R) -
                                             (2 * interval.omega_ie_n + interval.omega_en_n).cross(V));
  Vector<N> next = x;
  next.template segment<3>(At::position) += T * (V + 0.5 * dV - interval.omega_en_n.cross(R));
  next.template segment<3>(At::velocity) += dV;
  next.template segment<At::attitude_count>(At::attitude) += attitude_increment;
  return next;
}

template <int N>
void add_process_noise(Matrix<N, N>& P, const Settings& settings, double T,
                       const Matrix<Layout<N>::attitude_count, Layout<N>::attitude_count>& attitude_shape) {
  using At = Layout<N>;
  const double accel = settings.accel_noise_density * settings.accel_noise_density * T;
  const double gyro = settings.gyro_noise_density * settings.gyro_noise_density * T;
  P.diagonal().template segment<3>(At::velocity).array() += accel;
  P.template block<At::attitude_count, At::attitude_count>(At::attitude, At::attitude) +=
      gyro * attitude_shape;
  if constexpr (At::has_fix_bias) {
    const double walk = settings.fix_bias_noise_density * settings.fix_bias_noise_density * T;
    P.diagonal().template segment<3>(At::fix_bias).array() += walk;
  }
}

template Transition<3> kinematic_transition<3>(const Interval&);
template Transition<4> kinematic_transition<4>(const Interval&);
template Vector<15> moved<15>(const Vector<15>&, const Interval&, const Vector3d&, const Vector<3>&);
template Vector<18> moved<18>(const Vector<18>&, const Interval&, const Vector3d&, const Vector<3>&);
template Vector<16> moved<16>(const Vector<16>&, const Interval&, const Vector3d&, const Vector<4>&);
template Vector<19> moved<19>(const Vector<19>&, const Interval&, const Vector3d&, const Vector<4>&);
template void add_process_noise<15>(Matrix<15, 15>&, const Settings&, double, const Matrix<3, 3>&);
template void add_process_noise<18>(Matrix<18, 18>&, const Settings&, double, const Matrix<3, 3>&);
template void add_process_noise<16>(Matrix<16, 16>&, const Settings&, double, const Matrix<4, 4>&);
template void add_process_noise<19>(Matrix<19, 19>&, const Settings&, double, const Matrix<4, 4>&);

}  // namespace canhil::inflight_alignment
