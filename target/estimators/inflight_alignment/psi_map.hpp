#pragma once
// The prediction f of psi_angle.hpp over one interval, evaluated about a state x:
//   value       f(x)
//   even part   (f(x + d) + f(x - d))/2 - f(x)
//   odd part    (f(x + d) - f(x - d))/2
//   Jacobian    of f with respect to the biases
// The prediction uses only the first 15 states, so it works for the filters with 15 and with 18 states.
#include "target/estimators/filtering/unscented.hpp"
#include "target/estimators/inflight_alignment/error_model.hpp"

namespace canhil::inflight_alignment {

/// Sines and cosines of the psi angles.
struct Trig {
  Eigen::Vector3d sin, cos;  // of psi_x, psi_y, psi_z

  /// Computes sines and cosines of psi [rad].
  explicit Trig(const Eigen::Vector3d& psi);
  /// Takes sines and cosines that are already known.
  Trig(const Eigen::Vector3d& sine, const Eigen::Vector3d& cosine) : sin(sine), cos(cosine) {}
};

/// C_pc of psi.
Eigen::Matrix3d rotation(const Trig& t);

/// The two terms of the model that depend on psi and on the biases, for one interval.
struct Terms {
  Eigen::Vector3d force;  // C_pc (S - A n)
  Eigen::Vector3d rates;  // E [(w - C_pc' w) T - A e]
};

/// The map about a state, over one interval.
class PsiMap {
 public:
  /// About x; `interval` must outlive the map.
  PsiMap(const Vector<15>& x, const Interval& interval);

  /// The specific force's contribution to dV [m/s]. moved() computes the image of x from this contribution
  /// and from attitude_increment().
  [[nodiscard]] Eigen::Vector3d force_increment() const { return interval_.delta_v_n - terms_.force; }
  /// The increment of psi over the interval [rad].
  [[nodiscard]] const Eigen::Vector3d& attitude_increment() const { return terms_.rates; }

  /// The even and odd parts for x +- d; both points share one evaluation of sin and cos.
  [[nodiscard]] filtering::Parts<9> parts(const Vector<15>& d) const;

  /// C_pc A = d(velocity+)/d(accelerometer bias).
  [[nodiscard]] Eigen::Matrix3d velocity_accel() const;
  /// -E A = d(attitude+)/d(gyro bias).
  [[nodiscard]] Eigen::Matrix3d attitude_gyro() const;
  /// The length of the interval [s].
  [[nodiscard]] double duration() const { return interval_.duration; }

 private:
  // true_force = S - A n, drift = A e
  [[nodiscard]] Terms terms(const Trig& t, const Eigen::Vector3d& true_force,
                            const Eigen::Vector3d& drift) const;

  const Interval& interval_;
  Eigen::Vector3d wT_;  // (w_ie + w_en) T
  Trig trig_;
  Eigen::Vector3d true_force_, drift_;
  Terms terms_;
  Eigen::Vector3d coriolis_;
};

}  // namespace canhil::inflight_alignment
