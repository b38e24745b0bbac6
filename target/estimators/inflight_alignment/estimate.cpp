#include <algorithm>
#include <cmath>

#include "target/estimators/inflight_alignment/fix.hpp"
#include "target/estimators/inflight_alignment/psi_angle.hpp"
#include "target/estimators/inflight_alignment/sin_cos.hpp"

namespace canhil::inflight_alignment {
namespace {

using Eigen::Matrix3d;

template <int N>
Vector<N> errors_now(const Errors<N>& errors, const Interval& interval) {
  if (!(interval.duration > 0)) return errors.x;
  if constexpr (is_sin_cos<N>) {
    return predicted_sin_cos<N>(errors, interval);
  } else {
    return predicted<N>(errors.x, interval);
  }
}

// Widens the sigmas that the recommended filter reports. Its errors match its covariance, but there are many
// components and times in a run: one of 2,500 runs of 300 s would have some error beyond 5 sigma. So the
// sigmas of position, velocity and attitude are wider by 10 %. While the heading is not well known, its error
// is not normal (s and k are linear, the angle is not), so the sigmas of heading and velocity are also wider
// by the second order of the heading's sigma: by 1 % at 6 deg, by 25 % at 30 deg and beyond.
void widen(Uncertainty& u) {
  constexpr double margin = 1.1, share = 2, most = 0.55;
  const double by_heading = 1 + std::min(share * u.attitude(2, 2), most);
  u.attitude *= margin * margin;
  u.attitude(2, 2) *= by_heading;
  u.velocity *= margin * std::sqrt(by_heading);
  u.position *= margin;
}

template <class Visitor>
auto with_errors(const State& state, const Visitor& visitor) {
  return std::visit([&]<int N>(const Errors<N>& errors) { return visitor.template operator()<N>(errors); },
                    state.errors);
}

}  // namespace

Estimate estimate(const State& state) {
  return with_errors(state, [&]<int N>(const Errors<N>& errors) {
    using At = Layout<N>;
    const Vector<N> x = errors_now<N>(errors, state.ins.interval);
    Matrix3d C_pc;
    if constexpr (is_sin_cos<N>) {
      C_pc = tilt_and_heading<N>(x);
    } else {
      C_pc = platform_to_computer(x.template segment<3>(At::attitude));
    }
    Estimate best;
    best.nav = corrected(state.ins.nav, x.template segment<3>(At::position),
                         x.template segment<3>(At::velocity), C_pc);
    Matrix3d to_body = Matrix3d::Identity();
    if constexpr (is_sin_cos<N>) to_body = axes_of_biases<N>(errors);
    best.accel_bias = state.accel_bias + to_body * x.template segment<3>(At::accel_bias);
    best.gyro_bias = state.gyro_bias + to_body * x.template segment<3>(At::gyro_bias);
    best.fix_bias = state.fix_bias;
    if constexpr (At::has_fix_bias) best.fix_bias += x.template segment<3>(At::fix_bias);
    return best;
  });
}

Uncertainty uncertainty(const State& state) {
  return with_errors(state, []<int N>(Errors<N> errors) {
    using At = Layout<N>;
    Matrix<3, At::attitude_count> angles;
    if constexpr (is_sin_cos<N>) {
      turn_biases_back<N>(errors);
      angles = angles_of_states<N>(errors.x);
    } else {
      angles = rotation_axes(errors.x.template segment<3>(At::attitude));
    }
    const auto P_attitude = errors.P.template block<At::attitude_count, At::attitude_count>(6, 6);
    const Vector<N> sigma = errors.P.diagonal().cwiseMax(0).cwiseSqrt();
    Uncertainty u{.position = sigma.template segment<3>(At::position),
                  .velocity = sigma.template segment<3>(At::velocity),
                  .attitude = angles * P_attitude * angles.transpose(),
                  .accel_bias = sigma.template segment<3>(At::accel_bias),
                  .gyro_bias = sigma.template segment<3>(At::gyro_bias)};
    if constexpr (At::has_fix_bias) u.fix_bias = sigma.template segment<3>(At::fix_bias);
    if constexpr (is_sin_cos<N>) {
      if (errors.form == SinCosForm::levelled) widen(u);
    }
    return u;
  });
}

}  // namespace canhil::inflight_alignment
