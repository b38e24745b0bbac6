// Quantities of the wind estimate.
#pragma once

#include "bench/quantities/list.hpp"

namespace canhil::quantities {

/// The wind error: three components (along the horizontal air velocity, to the right of this velocity, and
/// down), and the norm of the three.
inline constexpr Quantity wind_along{
    .name = "wind.along", .meaning = "error of the wind along the horizontal air velocity", .unit = mps};
inline constexpr Quantity wind_cross{
    .name = "wind.cross",
    .meaning = "error of the wind to the right of the horizontal air velocity",
    .unit = mps};
inline constexpr Quantity wind_down{
    .name = "wind.down", .meaning = "error of the wind downwards", .unit = mps};
inline constexpr Quantity wind_norm{
    .name = "wind.norm", .meaning = "magnitude of the error of the wind", .unit = mps};
inline constexpr Quantity wind_north{.name = "wind.north", .meaning = "error of the wind north", .unit = mps};
inline constexpr Quantity wind_east{.name = "wind.east", .meaning = "error of the wind east", .unit = mps};
/// The horizontal wind as its speed and the direction from which it blows, which the target reports apart.
inline constexpr Quantity wind_speed{
    .name = "wind.speed", .meaning = "error of the speed of the horizontal wind", .unit = mps};
inline constexpr Quantity wind_from{
    .name = "wind.from", .meaning = "error of the direction from which the wind blows", .unit = degrees};
/// NIS of a sample; NaN without an update.
inline constexpr Quantity wind_nis{.name = "wind.nis",
                                   .meaning = "normalised innovation squared of an update",
                                   .unit = plain,
                                   .degrees_of_freedom = 9,
                                   .white = true,
                                   .nan_allowed = true};
inline constexpr Quantity wind_nees{
    .name = "wind.nees",
    .meaning = "normalised error squared of the wind, with sigmas and correlations as reported",
    .unit = plain,
    .degrees_of_freedom = 3};
/// The reported sigma of the wind along the horizontal air velocity.
inline constexpr Quantity wind_along_sigma{
    .name = "wind.along.sigma",
    .meaning = "sigma of the wind along the horizontal air velocity, as the target reports it",
    .unit = mps};
inline constexpr Quantity wind_along_over_sigma{
    .name = "wind.along.over_sigma",
    .meaning = "ratio of the error of the wind along the horizontal air velocity to its sigma",
    .unit = plain};

}  // namespace canhil::quantities
