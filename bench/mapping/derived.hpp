// Quantities that the bench computes from those that a mapped target reports: errors of the position in
// metres, magnitudes of vectors, NEES and NIS.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "bench/quantities/track.hpp"
#include "bench/world/flight_record.hpp"

namespace canhil::mapping {

/// The values of several quantities at one time.
struct Joint {
  std::span<const quantities::TrackPoint> parts;  ///< in SI
  /// The reported correlation of the errors of two parts; 0: the target reports none.
  std::function<double(std::size_t one, std::size_t other)> correlation;
  const world::FlightRecord& flight;
};

/// Computes a derived quantity; nullopt: it has no value.
using Derive = std::optional<quantities::TrackPoint> (*)(const Joint& joint);

/// The error [m] of a latitude, a longitude or a height, to the north, to the east or down: r_N = (R_N + h)
/// dL, r_E = (R_E + h) cos L dlambda, r_D = -dh (Groves 2013, eq. (2.111)).
std::optional<quantities::TrackPoint> north_of_latitude(const Joint& latitude);
std::optional<quantities::TrackPoint> east_of_longitude(const Joint& longitude);
std::optional<quantities::TrackPoint> down_of_height(const Joint& height);
/// The magnitude [m] of the horizontal error of a latitude and a longitude.
std::optional<quantities::TrackPoint> horizontal(const Joint& latitude_longitude);
/// The magnitude of a vector.
std::optional<quantities::TrackPoint> magnitude(const Joint& parts);
/// e^T P^-1 e, where P = D R D has the sigmas (D) and the correlations (R). No value without all sigmas; NaN
/// if P is not positive definite. The units of the parts cancel out.
std::optional<quantities::TrackPoint> normalised_squared(const Joint& parts);

/// The size [m] of a radian of latitude or longitude at a time of the flight.
double metres_of_latitude(const world::FlightRecord& flight, std::int64_t t_us);
double metres_of_longitude(const world::FlightRecord& flight, std::int64_t t_us);

}  // namespace canhil::mapping
