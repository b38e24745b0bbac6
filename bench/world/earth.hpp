// WGS-84: radii of curvature, Earth rotation, normal gravity, and the change of position with velocity.
#pragma once

#include "bench/world/attitude.hpp"

namespace canhil::world {

/// Geodetic position, WGS-84.
struct Position {
  double latitude = 0;   ///< [rad]
  double longitude = 0;  ///< [rad]
  double height = 0;     ///< above the ellipsoid [m]
};

/// The longitude, wrapped to -180 to 180 deg, the range of the longitude signals on the bus.
/// Position::longitude is not wrapped: along a flight it continues beyond 180 deg.
double longitude_deg(const Position& position);

/// Meridian radius of curvature R_N of Groves (2013), eq. (2.105) [m].
double meridian_radius(double latitude);
/// Transverse radius of curvature R_E of Groves (2013), eq. (2.106) [m].
double transverse_radius(double latitude);

/// Earth rate in NED [rad/s]. Groves (2013), eq. (2.123).
Vector3 omega_ie_n(double latitude);
/// Transport rate in NED [rad/s]. Groves (2013), eq. (5.44).
Vector3 omega_en_n(const Position& position, const Vector3& v_eb_n);

/// Normal gravity of WGS-84 in NED [m/s^2], including its north component, which vanishes on the ellipsoid.
Vector3 gravity_n(const Position& position);

/// The time derivative of the position (latitude and longitude in rad/s, height in m/s), for a velocity in
/// NED [m/s]. Groves (2013), eq. (2.111).
Position position_rate(const Position& position, const Vector3& v_eb_n);

/// The position after dt [s], by one fourth-order Runge-Kutta step from the velocities in NED [m/s] at the
/// beginning, in the middle and at the end.
Position advanced(const Position& position, const Vector3& v_begin, const Vector3& v_middle,
                  const Vector3& v_end, double dt);

/// The position at a small displacement in NED [m] (accurate to first order in the ratio of displacement to
/// Earth radius).
Position displaced(const Position& position, const Vector3& displacement_n);

/// The displacement in NED [m] between two nearby positions, also across the meridian of 180 deg, computed
/// with the radii of curvature at `from`. Inverse of displaced().
Vector3 displacement_n(const Position& from, const Position& to);

}  // namespace canhil::world
