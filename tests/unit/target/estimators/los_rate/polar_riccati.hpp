#pragma once
// Integrates the filter's differential Riccati equation in polar states, as a reference for the closed forms.
#include <Eigen/Core>
#include <cmath>

#include "target/estimators/los_rate/closed_form.hpp"
#include "tests/unit/target/estimators/reference_matrix.hpp"

namespace canhil::los_rate {

inline Eigen::Matrix3d matrix(const Covariance& P) {
  Eigen::Matrix3d m;
  m << P.ee, P.ew, P.ea, P.ew, P.ww, P.wa, P.ea, P.wa, P.aa;
  return m;
}
inline Eigen::Vector3d vector(const Gain& K) { return {K.e, K.w, K.a}; }

/// Largest relative difference of the entries.
inline double relative_difference(const Dense& value, const Dense& reference) {
  return largest(entrywise_quotient(value - reference, reference));
}

/// Integrates P' = F P + P F' + q G G' - P H'H P/(R(r) Ts) from r_begin to r_end [m] at constant vc, by the
/// classical Runge-Kutta method. Calls inspect(r, P) after each step.
template <class Inspect>
Eigen::Matrix3d integrate_riccati(Eigen::Matrix3d P, const Noise& noise, double q, double Ts, double vc,
                                  double r_begin, double r_end, Inspect inspect) {
  const auto slope = [&](const Eigen::Matrix3d& at, double r) -> Eigen::Matrix3d {
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    F(0, 1) = 1;
    F(1, 1) = 2 * vc / r;
    F(1, 2) = 1 / r;
    Eigen::Matrix3d result = F * at + at * F.transpose();
    result -= at.col(0) * at.row(0) / (sample_variance(noise, r) * Ts);
    result(2, 2) += q;
    return result;
  };
  double r = r_begin;
  while (r > r_end) {
    // The step is a small fraction of the filter's time constant 1/Omega; the last step ends at r_end.
    const double Omega = std::pow(q / displacement_noise(noise, {r, vc}, Ts).R_y, 1.0 / 6);
    const double dt = std::min(0.004 / Omega, (r - r_end) / vc);
    const Eigen::Matrix3d k1 = slope(P, r), k2 = slope(P + dt / 2 * k1, r - vc * dt / 2);
    const Eigen::Matrix3d k3 = slope(P + dt / 2 * k2, r - vc * dt / 2);
    const Eigen::Matrix3d k4 = slope(P + dt * k3, r - vc * dt);
    P += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    r -= vc * dt;
    if (r_end + 1e-6 > r) r = r_end;
    inspect(r, P);
  }
  return P;
}

/// The Kalman gain P H'/(R Ts).
inline Eigen::Vector3d riccati_gain(const Eigen::Matrix3d& P, const Noise& noise, double r, double Ts) {
  return P.col(0) / (sample_variance(noise, r) * Ts);
}

}  // namespace canhil::los_rate
