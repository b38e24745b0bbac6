#pragma once
// The paper's flight (level, heading 0, 500 km/h north for 10 s, then 9.81 m/s^2 north) and its error-free
// IMU, as in the published vectors.
#include <Eigen/Geometry>

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/strapdown/earth.hpp"
#include "target/estimators/strapdown/mechanization.hpp"
#include "target/estimators/transfer_alignment/settings.hpp"

namespace canhil::transfer_alignment {

inline constexpr double flight_acceleration = 9.81;  // [m/s^2]

inline strapdown::NavState flight_start() {
  strapdown::NavState nav;
  nav.latitude = 37 * rad_per_deg;
  nav.height = 1000;
  nav.v_eb_n << 500 / 3.6, 0, 0;
  return nav;
}

/// The slave's navigation state whose errors (computed - true) are dV [m/s] and phi [rad].
inline strapdown::NavState with_errors(strapdown::NavState nav, const Eigen::Vector3d& dV,
                                       const Eigen::Vector3d& phi) {
  nav.v_eb_n += dV;
  nav.C_bn = strapdown::exp_rotation(-phi) * nav.C_bn;
  return nav;
}

/// The start of the published runs: 5 deg and 1 m/s on each axis.
inline strapdown::NavState published_start() {
  return with_errors(flight_start(), Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(5 * rad_per_deg));
}

/// The true state a sample of dt [s] after `nav` at t [s]: constant acceleration, latitude by the trapezoidal
/// rule.
inline strapdown::NavState flight_next(const strapdown::NavState& nav, double t, double dt) {
  strapdown::NavState next = nav;
  if (t + dt / 2 > 10) next.v_eb_n.x() += flight_acceleration * dt;
  const strapdown::LocalEarth earth = strapdown::local_earth(nav.latitude, nav.height);
  next.latitude += (nav.v_eb_n.x() + next.v_eb_n.x()) / 2 * dt / (earth.meridian_radius + nav.height);
  return next;
}

/// The increments of that sample: mean rate and specific force with the earth at its middle.
inline strapdown::ImuIncrement flight_increment(const strapdown::NavState& nav, double t, double dt) {
  const strapdown::NavState middle = flight_next(nav, t + dt / 4, dt / 2);
  const strapdown::LocalEarth earth = strapdown::local_earth(middle.latitude, middle.height);
  const Eigen::Vector3d omega_en = strapdown::transport_rate(earth, middle.height, middle.v_eb_n);
  const Eigen::Vector3d acceleration(t + dt / 2 < 10 ? 0 : flight_acceleration, 0, 0);
  const Eigen::Vector3d coriolis = (2 * earth.omega_ie_n + omega_en).cross(middle.v_eb_n);
  const Eigen::Vector3d force = acceleration + coriolis - Eigen::Vector3d(0, 0, earth.gravity);
  return {(earth.omega_ie_n + omega_en) * dt, force * dt, dt};
}

}  // namespace canhil::transfer_alignment
