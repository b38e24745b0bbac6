#pragma once
// The WGS-84 earth at (latitude, height): radii, gravity, rates in north-east-down axes.
#include <Eigen/Core>

namespace canhil::strapdown {

/// Rotation rate of the Earth (WGS-84) [rad/s].
inline constexpr double earth_rate = 7.292115e-5;
/// Semi-major axis of the WGS-84 ellipsoid [m].
inline constexpr double semi_major_axis = 6378137.0;
/// Squared eccentricity of the WGS-84 ellipsoid.
inline constexpr double eccentricity_squared = 6.69437999014e-3;
/// Decrease of gravity with height [1/s^2].
inline constexpr double free_air_gradient = 3.086e-6;

/// Radii, gravity and rates at a place.
struct LocalEarth {
  double sin_latitude, cos_latitude;
  double meridian_radius, transverse_radius;  // of curvature, at height 0 [m]
  double ellipsoid_gravity;                   // at height 0 [m/s^2]
  double gravity;                             // at the given height, linear free-air gradient [m/s^2]
  Eigen::Vector3d omega_ie_n;                 // earth's rate [rad/s]
};

/// The earth at a latitude [rad] and height [m] (Groves 2013, eqs. 2.105, 2.106, 2.123, 2.134 with the linear
/// gradient).
LocalEarth local_earth(double latitude, double height);

/// omega_en_n [rad/s] for velocity v_eb_n [m/s] at a height [m]; singular at the poles (Groves 2013,
/// eq. 5.44).
inline Eigen::Vector3d transport_rate(const LocalEarth& earth, double height, const Eigen::Vector3d& v_eb_n) {
  const double east = v_eb_n.y() / (earth.transverse_radius + height);
  return {east, -v_eb_n.x() / (earth.meridian_radius + height),
          -east * (earth.sin_latitude / earth.cos_latitude)};
}

}  // namespace canhil::strapdown
