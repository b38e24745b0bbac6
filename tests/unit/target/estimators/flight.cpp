#include "tests/unit/target/estimators/flight.hpp"

#include <Eigen/Geometry>

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/strapdown/earth.hpp"

namespace canhil::transfer_alignment {

strapdown::NavState flight_start() {
  strapdown::NavState nav;
  nav.latitude = 37 * rad_per_deg;
  nav.height = 1000;
  nav.v_eb_n << 500 / 3.6, 0, 0;
  return nav;
}

strapdown::NavState with_errors(strapdown::NavState nav, const Eigen::Vector3d& dV,
                                const Eigen::Vector3d& phi) {
  nav.v_eb_n += dV;
  nav.C_bn = strapdown::exp_rotation(-phi) * nav.C_bn;
  return nav;
}

strapdown::NavState published_start() {
  return with_errors(flight_start(), Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(5 * rad_per_deg));
}

strapdown::NavState flight_next(const strapdown::NavState& nav, double t, double dt) {
  strapdown::NavState next = nav;
  if (t + dt / 2 > 10) next.v_eb_n.x() += flight_acceleration * dt;
  const strapdown::LocalEarth earth = strapdown::local_earth(nav.latitude, nav.height);
  next.latitude += (nav.v_eb_n.x() + next.v_eb_n.x()) / 2 * dt / (earth.meridian_radius + nav.height);
  return next;
}

strapdown::ImuIncrement flight_increment(const strapdown::NavState& nav, double t, double dt) {
  const strapdown::NavState middle = flight_next(nav, t + dt / 4, dt / 2);
  const strapdown::LocalEarth earth = strapdown::local_earth(middle.latitude, middle.height);
  const Eigen::Vector3d omega_en = strapdown::transport_rate(earth, middle.height, middle.v_eb_n);
  const Eigen::Vector3d acceleration(t + dt / 2 < 10 ? 0 : flight_acceleration, 0, 0);
  const Eigen::Vector3d coriolis = (2 * earth.omega_ie_n + omega_en).cross(middle.v_eb_n);
  const Eigen::Vector3d force = acceleration + coriolis - Eigen::Vector3d(0, 0, earth.gravity);
  return {(earth.omega_ie_n + omega_en) * dt, force * dt, dt};
}

}  // namespace canhil::transfer_alignment
