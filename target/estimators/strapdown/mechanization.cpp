#include "target/estimators/strapdown/mechanization.hpp"

#include <Eigen/Geometry>

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/strapdown/earth.hpp"

namespace canhil::strapdown {
namespace {

// Advances the position by the mean of the velocities at both ends of the step, with the radii and the height
// at the start (Groves 2013, eq. 5.56). The rate of the longitude is computed with the radius of the circle
// of latitude at the start (share_of_end 0) or at the end (share_of_end 1) of the step.
void advance_position(NavState& nav, const NavState& from, const LocalEarth& earth, double dt,
                      double share_of_end = 0) {
  const Eigen::Vector3d mean = 0.5 * (from.v_eb_n + nav.v_eb_n);
  nav.latitude = from.latitude + mean.x() * dt / (earth.meridian_radius + from.height);
  const double cos_latitude =
      earth.cos_latitude - share_of_end * earth.sin_latitude * (nav.latitude - from.latitude);
  nav.longitude = from.longitude + mean.y() * dt / ((earth.transverse_radius + from.height) * cos_latitude);
  nav.height = from.height - mean.z() * dt;
}

}  // namespace

MechanizationStep mechanize_reference(const NavState& nav, const ImuIncrement& imu) {
  const LocalEarth earth = local_earth(nav.latitude, nav.height);
  MechanizationStep step;
  step.omega_ie_n = earth.omega_ie_n;
  step.omega_en_n = transport_rate(earth, nav.height, nav.v_eb_n);

  const Eigen::Vector3d zeta = (step.omega_ie_n + step.omega_en_n) * imu.dt;
  step.nav.C_bn = exp_rotation(-zeta) * nav.C_bn * exp_rotation(imu.delta_theta);
  step.C_bn_mean = 0.5 * (nav.C_bn + step.nav.C_bn);
  step.delta_v_n = step.C_bn_mean * imu.delta_v;

  const Eigen::Vector3d gravity(0, 0, earth.gravity);
  const Eigen::Vector3d coriolis = 2 * step.omega_ie_n + step.omega_en_n;
  step.nav.v_eb_n = nav.v_eb_n + step.delta_v_n + (gravity - coriolis.cross(nav.v_eb_n)) * imu.dt;
  advance_position(step.nav, nav, earth, imu.dt);
  return step;
}

MechanizationStep mechanize_two_sample(const NavState& nav, const ImuIncrement& previous,
                                       const ImuIncrement& imu) {
  const double dt = imu.dt;
  // Let T be the length of the previous sample, and let the rate be w = a + b t. Then the coning term is
  // (a x b) dt^3/12, and the previous increment x the current increment is (a x b) T dt (T + dt)/2. The ratio
  // of the two is `factor` (1/12 for T = dt); sculling has the same factor.
  const double factor = previous.dt > 0 ? dt * dt / (6 * previous.dt * (previous.dt + dt)) : 0;
  const Eigen::Vector3d phi = imu.delta_theta + factor * previous.delta_theta.cross(imu.delta_theta);
  const Eigen::Vector3d turned = imu.delta_theta.cross(imu.delta_v);
  const Eigen::Vector3d delta_v_b =
      imu.delta_v + 0.5 * turned + imu.delta_theta.cross(turned) / 6 +
      factor * (previous.delta_theta.cross(imu.delta_v) + previous.delta_v.cross(imu.delta_theta));

  const LocalEarth earth = local_earth(nav.latitude, nav.height);
  const Eigen::Vector3d gravity(0, 0, earth.gravity);
  const Eigen::Vector3d omega_en_start = transport_rate(earth, nav.height, nav.v_eb_n);
  const Eigen::Vector3d zeta_start = (earth.omega_ie_n + omega_en_start) * dt;

  MechanizationStep step;
  const Eigen::Vector3d unturned = nav.C_bn * delta_v_b;
  step.delta_v_n = unturned - 0.5 * zeta_start.cross(unturned);  // the n axes turn during the sample
  const Eigen::Vector3d coriolis_start = 2 * earth.omega_ie_n + omega_en_start;
  const Eigen::Vector3d v_middle =
      nav.v_eb_n + 0.5 * (step.delta_v_n + (gravity - coriolis_start.cross(nav.v_eb_n)) * dt);
  step.omega_ie_n = earth.omega_ie_n;
  step.omega_en_n = transport_rate(earth, nav.height, v_middle);
  const Eigen::Vector3d coriolis = 2 * step.omega_ie_n + step.omega_en_n;
  step.nav.v_eb_n = nav.v_eb_n + step.delta_v_n + (gravity - coriolis.cross(v_middle)) * dt;
  advance_position(step.nav, nav, earth, dt);

  const Eigen::Vector3d zeta = (step.omega_ie_n + step.omega_en_n) * dt;
  step.nav.C_bn = exp_rotation(-zeta) * nav.C_bn * exp_rotation(phi);
  step.C_bn_mean = 0.5 * (nav.C_bn + step.nav.C_bn);
  return step;
}

MechanizationStep mechanize_one_sample(const NavState& nav, const ImuIncrement& imu) {
  const LocalEarth earth = local_earth(nav.latitude, nav.height);
  MechanizationStep step;
  step.omega_ie_n = earth.omega_ie_n;
  step.omega_en_n = transport_rate(earth, nav.height, nav.v_eb_n);

  const Eigen::Vector3d zeta_b = nav.C_bn.transpose() * (step.omega_ie_n + step.omega_en_n) * imu.dt;
  step.nav.C_bn = nav.C_bn * exp_rotation(imu.delta_theta - zeta_b);
  step.C_bn_mean = 0.5 * (nav.C_bn + step.nav.C_bn);
  step.delta_v_n = nav.C_bn * (imu.delta_v + 0.5 * imu.delta_theta.cross(imu.delta_v));

  const Eigen::Vector3d gravity(0, 0, earth.ellipsoid_gravity * (1 - 2 * nav.height / semi_major_axis));
  const Eigen::Vector3d coriolis = 2 * step.omega_ie_n + step.omega_en_n;
  step.nav.v_eb_n = nav.v_eb_n + step.delta_v_n + (gravity - coriolis.cross(nav.v_eb_n)) * imu.dt;
  advance_position(step.nav, nav, earth, imu.dt, 1);
  return step;
}

MechanizationStep mechanize(Mechanization kind, const NavState& nav, const ImuIncrement& previous,
                            const ImuIncrement& imu) {
  switch (kind) {
    case Mechanization::reference:
      return mechanize_reference(nav, imu);
    case Mechanization::one_sample:
      return mechanize_one_sample(nav, imu);
    case Mechanization::two_sample:
      break;
  }
  return mechanize_two_sample(nav, previous, imu);
}

}  // namespace canhil::strapdown
