#include "bench/mapping/derived.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "bench/world/earth.hpp"

namespace canhil::mapping {
namespace {

using quantities::TrackPoint;
using MaybePoint = std::optional<TrackPoint>;

// `way`: how far the vehicle is from its position at the start [m].
TrackPoint scaled(const TrackPoint& from, double factor, double way) {
  const double error = from.value * factor;
  TrackPoint point{.t_us = from.t_us, .value = error, .estimate = way + error, .truth = way};
  if (from.sigma) point.sigma = *from.sigma * std::abs(factor);
  return point;
}

world::Vector3 way(const Joint& joint) {
  return displacement_n(joint.flight.epochs().front().position,
                        joint.flight.at(joint.parts.back().t_us).position);
}

}  // namespace

double metres_of_latitude(const world::FlightRecord& flight, std::int64_t t_us) {
  const world::Position at = flight.at(t_us).position;
  return world::meridian_radius(at.latitude) + at.height;
}

double metres_of_longitude(const world::FlightRecord& flight, std::int64_t t_us) {
  const world::Position at = flight.at(t_us).position;
  return (world::transverse_radius(at.latitude) + at.height) * std::cos(at.latitude);
}

MaybePoint north_of_latitude(const Joint& latitude) {
  const TrackPoint& point = latitude.parts.front();
  return scaled(point, metres_of_latitude(latitude.flight, point.t_us), way(latitude).x());
}

MaybePoint east_of_longitude(const Joint& longitude) {
  const TrackPoint& point = longitude.parts.front();
  return scaled(point, metres_of_longitude(longitude.flight, point.t_us), way(longitude).y());
}

MaybePoint down_of_height(const Joint& height) { return scaled(height.parts.front(), -1, way(height).z()); }

MaybePoint horizontal(const Joint& latitude_longitude) {
  const std::int64_t t_us = latitude_longitude.parts.back().t_us;
  const double north =
      latitude_longitude.parts[0].value * metres_of_latitude(latitude_longitude.flight, t_us);
  const double east =
      latitude_longitude.parts[1].value * metres_of_longitude(latitude_longitude.flight, t_us);
  return TrackPoint{.t_us = t_us, .value = std::hypot(north, east)};
}

MaybePoint magnitude(const Joint& parts) {
  double squares = 0;
  for (const TrackPoint& part : parts.parts) squares += part.value * part.value;
  return TrackPoint{.t_us = parts.parts.back().t_us, .value = std::sqrt(squares)};
}

MaybePoint normalised_squared(const Joint& parts) {
  constexpr int most = 3;
  const auto n = static_cast<Eigen::Index>(parts.parts.size());
  // With e and P divided by the sigmas, P is R.
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1> e(n);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most> R(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const TrackPoint& part = parts.parts[static_cast<std::size_t>(i)];
    if (!part.sigma) return std::nullopt;
    e[i] = part.value / *part.sigma;
    R(i, i) = 1;
    for (Eigen::Index j = 0; j < i; ++j)
      R(i, j) = R(j, i) = parts.correlation(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  const Eigen::LLT<decltype(R)> factor(R);
  const double value =
      factor.info() == Eigen::Success ? e.dot(factor.solve(e)) : std::numeric_limits<double>::quiet_NaN();
  return TrackPoint{.t_us = parts.parts.back().t_us, .value = value};
}

}  // namespace canhil::mapping
