#pragma once
// The common error model of the in-flight alignment filters: errors of the INS (INS minus true), in the NED
// axes of the computer frame c, over an interval T between fixes.
//   dR+ = dR + (dV + dV+) T/2 - w_en x dR T
//   dV+ = dV + (force term) - (2 w_ie + w_en) x dV T + dg T      dg: gravity error, for an open loop
// (Kang, Kim, Park 2006, eq. (9); corrected: the paper omits the gravity error). Each filter has its own
// attitude model; biases of sensors and fixes are constant. The states are dR and dV; the attitude, which is
// either three psi angles or two tilts and two functions of the heading error (sin and 1 - cos); and the
// biases of accelerometer, gyro and optionally the fix. With psi there are 15 states, or 18 with fix bias;
// with sin and cos there are 16 states, or 19 with fix bias.
#include <Eigen/Core>

#include "target/estimators/filtering/kalman.hpp"
#include "target/estimators/inflight_alignment/settings.hpp"
#include "target/estimators/strapdown/interval.hpp"

namespace canhil::inflight_alignment {

using filtering::Matrix;
using filtering::Vector;
using strapdown::Interval;

/// Indices of the states in a filter with N states.
template <int N>
struct Layout {
  static_assert(N == 15 || N == 16 || N == 18 || N == 19);
  static constexpr bool has_fix_bias = N >= 18;
  static constexpr int attitude_count = N % 3 == 0 ? 3 : 4;
  static constexpr int position = 0, velocity = 3, attitude = 6;
  static constexpr int moving = 6 + attitude_count;  // number of (leading) states that change in time
  static constexpr int accel_bias = moving, gyro_bias = moving + 3, fix_bias = moving + 6;
};

/// The sigmas that a fix reports; 0: not reported. The filter uses the larger one of these and those of the
/// settings.
struct FixSigma {
  double horizontal = 0;  // each of north and east [m]
  double vertical = 0;    // [m]
};

/// Estimated errors x [N] and their covariance P [N x N], in the order of Layout.
template <int N>
struct Errors {
  Vector<N> x = Vector<N>::Zero();
  Matrix<N, N> P = Matrix<N, N>::Zero();
  SinCosForm form = SinCosForm::levelled;  // used only by sin_cos
  // levelled: sum, since the last fix, of the sigmas of the vertical force's second-order term [m/s]
  double second_order = 0;
};

/// The gravity error of an INS per metre of its position error dR, NED: the gravity error dg [m/s^2] is the
/// element-wise product of gravity_error_per_m() and dR.
inline Eigen::Vector3d gravity_error_per_m() {
  constexpr double rate = standard_gravity / 6378137;
  return {-rate, -rate, 2 * rate};
}

/// The non-zero blocks of G = dx+/dx - I for the moving states. The position rows of G follow from the
/// velocity rows of G.
template <int A>
struct Transition {
  double T = 0;
  Eigen::Matrix3d transport, coriolis;  // -[w_en x] T, -[(2 w_ie + w_en) x] T
  Matrix<3, A> velocity_attitude;
  Eigen::Matrix3d velocity_accel;
  Matrix<A, A> attitude_attitude;
  Matrix<A, 3> attitude_gyro;
};

/// The blocks that do not depend on the attitude.
template <int A>
Transition<A> kinematic_transition(const Interval& interval);

/// (I + G) P (I + G)'.
template <int N, int A>
Matrix<N, N> propagated(const Matrix<N, N>& P, const Transition<A>& G);

/// x after the interval, given the specific force's contribution to dV [m/s] and the increment of the
/// attitude.
template <int N>
Vector<N> moved(const Vector<N>& x, const Interval& interval, const Eigen::Vector3d& force_increment,
                const Vector<Layout<N>::attitude_count>& attitude_increment);

/// Adds the noise of an interval T [s] to P: the white noise of accelerometers and gyros to the velocity and
/// attitude blocks, and the random walk of the fix bias to the block of the fix bias. attitude_shape is the
/// covariance of the attitude states for unit noise.
template <int N>
void add_process_noise(Matrix<N, N>& P, const Settings& settings, double T,
                       const Matrix<Layout<N>::attitude_count, Layout<N>::attitude_count>& attitude_shape);

}  // namespace canhil::inflight_alignment
