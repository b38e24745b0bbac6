#include "target/estimators/wind/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canhil::wind {

using Eigen::Vector2d;

Estimate estimate(const StateVector& x) {
  Estimate e;
  e.air_velocity = x.segment<3>(air_velocity_at);
  e.rate = x.segment<3>(rate_at);
  e.attitude = x.segment<3>(attitude_at);
  e.wind = x.segment<3>(wind_at);
  e.wind_speed = std::hypot(e.wind.x(), e.wind.y());
  e.wind_from = e.wind_speed > 0 ? std::atan2(-e.wind.y(), -e.wind.x()) : 0;
  if (e.wind_from < 0) e.wind_from += 2 * std::numbers::pi;
  if (e.wind_from >= 2 * std::numbers::pi) e.wind_from = 0;  // a tiny negative angle plus 2 pi rounds to 2 pi
  e.air_speed = e.air_velocity.norm();
  e.alpha = std::atan2(e.air_velocity.z(), e.air_velocity.x());
  e.beta = std::atan2(e.air_velocity.y(), std::hypot(e.air_velocity.x(), e.air_velocity.z()));
  return e;
}

Uncertainty uncertainty(const StateVector& x, const Covariance& P) {
  const Eigen::Matrix2d horizontal = P.block<2, 2>(wind_at, wind_at);
  const auto sigma_along = [&horizontal](const Vector2d& axis) {
    return std::sqrt(std::max(axis.dot(horizontal * axis), 0.0));
  };
  const auto right_of = [](const Vector2d& axis) { return Vector2d(-axis.y(), axis.x()); };
  const auto direction_of = [](const Vector2d& v) {
    const double length = v.norm();
    return length > 0 ? Vector2d(v / length) : Vector2d(1, 0);
  };
  Uncertainty u;
  u.state = P.diagonal().cwiseMax(0).cwiseSqrt();
  const Vector2d wind = x.segment<2>(wind_at), blow = direction_of(wind);
  const Vector2d track =
      direction_of((C_bn(x.segment<3>(attitude_at)) * x.segment<3>(air_velocity_at)).head<2>());
  u.wind_speed = sigma_along(blow);
  const double unknown = std::numbers::pi / std::numbers::sqrt3;
  const double speed = wind.norm();
  u.wind_from = speed > 0 ? std::min(sigma_along(right_of(blow)) / speed, unknown) : unknown;
  u.along_track = sigma_along(track);
  u.cross_track = sigma_along(right_of(track));
  return u;
}

}  // namespace canhil::wind
