// Quantities that only transfer alignment has.
#pragma once

#include "bench/quantities/list.hpp"

namespace canhil::quantities {

/// NEES of the misalignment, with the covariance of AlignAttitudeSigma and AlignAttitudeCorrelation.
inline constexpr Quantity attitude_nees{
    .name = "attitude.nees",
    .meaning = "normalised error squared of the misalignment, with sigmas and correlations as reported",
    .unit = plain,
    .degrees_of_freedom = 3,
    .nan_allowed = true};

/// The innovation of a velocity update, NED.
inline constexpr Quantity velocity_innovation_north{
    .name = "innovation.velocity.north",
    .meaning = "north component of the innovation of a velocity",
    .unit = mps,
    .white = true};
inline constexpr Quantity velocity_innovation_east{
    .name = "innovation.velocity.east",
    .meaning = "east component of the innovation of a velocity",
    .unit = mps,
    .white = true};
inline constexpr Quantity velocity_innovation_down{
    .name = "innovation.velocity.down",
    .meaning = "down component of the innovation of a velocity",
    .unit = mps,
    .white = true};

}  // namespace canhil::quantities
