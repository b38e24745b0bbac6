#include "bench/world/earth.hpp"

#include <GeographicLib/Constants.hpp>
#include <GeographicLib/NormalGravity.hpp>
#include <cmath>

#include "bench/world/attitude.hpp"
#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

const GeographicLib::NormalGravity& wgs84() { return GeographicLib::NormalGravity::WGS84(); }

double e2() {
  const double f = GeographicLib::Constants::WGS84_f();
  return f * (2.0 - f);
}

Position moved(const Position& position, const Position& rate, double dt) {
  return {.latitude = position.latitude + rate.latitude * dt,
          .longitude = position.longitude + rate.longitude * dt,
          .height = position.height + rate.height * dt};
}

// 1 - e^2 sin^2(latitude)
double radius_divisor(double latitude) {
  const double s = std::sin(latitude);
  return 1.0 - e2() * s * s;
}

}  // namespace

double longitude_deg(const Position& position) { return wrapped(position.longitude) / units::deg; }

double meridian_radius(double latitude) {
  const double d = radius_divisor(latitude);
  return GeographicLib::Constants::WGS84_a() * (1.0 - e2()) / (d * std::sqrt(d));
}

double transverse_radius(double latitude) {
  return GeographicLib::Constants::WGS84_a() / std::sqrt(radius_divisor(latitude));
}

Vector3 omega_ie_n(double latitude) {
  const double rate = wgs84().AngularVelocity();
  return {rate * std::cos(latitude), 0.0, -rate * std::sin(latitude)};
}

Vector3 omega_en_n(const Position& position, const Vector3& v_eb_n) {
  const double east_rate = v_eb_n.y() / (transverse_radius(position.latitude) + position.height);
  return {east_rate, -v_eb_n.x() / (meridian_radius(position.latitude) + position.height),
          -east_rate * std::tan(position.latitude)};
}

Vector3 gravity_n(const Position& position) {
  double north = 0;
  double up = 0;
  wgs84().Gravity(position.latitude / units::deg, position.height, north, up);
  return {north, 0.0, -up};
}

Position position_rate(const Position& position, const Vector3& v_eb_n) {
  const double north_radius = meridian_radius(position.latitude) + position.height;
  const double east_radius =
      (transverse_radius(position.latitude) + position.height) * std::cos(position.latitude);
  return {
      .latitude = v_eb_n.x() / north_radius, .longitude = v_eb_n.y() / east_radius, .height = -v_eb_n.z()};
}

Position advanced(const Position& position, const Vector3& v_begin, const Vector3& v_middle,
                  const Vector3& v_end, double dt) {
  const Position k1 = position_rate(position, v_begin);
  const Position k2 = position_rate(moved(position, k1, 0.5 * dt), v_middle);
  const Position k3 = position_rate(moved(position, k2, 0.5 * dt), v_middle);
  const Position k4 = position_rate(moved(position, k3, dt), v_end);
  const auto mean = [](double a, double b, double c, double d) { return (a + 2.0 * (b + c) + d) / 6.0; };
  const Position rate{.latitude = mean(k1.latitude, k2.latitude, k3.latitude, k4.latitude),
                      .longitude = mean(k1.longitude, k2.longitude, k3.longitude, k4.longitude),
                      .height = mean(k1.height, k2.height, k3.height, k4.height)};
  return moved(position, rate, dt);
}

Position displaced(const Position& position, const Vector3& displacement_n) {
  const Position step = position_rate(position, displacement_n);
  return {.latitude = position.latitude + step.latitude,
          .longitude = position.longitude + step.longitude,
          .height = position.height + step.height};
}

Vector3 displacement_n(const Position& from, const Position& to) {
  return {(to.latitude - from.latitude) * (meridian_radius(from.latitude) + from.height),
          wrapped(to.longitude - from.longitude) * (transverse_radius(from.latitude) + from.height) *
              std::cos(from.latitude),
          -(to.height - from.height)};
}

}  // namespace canhil::world
