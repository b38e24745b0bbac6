// Quantities that only in-flight alignment has.
#pragma once

#include "bench/quantities/list.hpp"

namespace canhil::quantities {

/// The position error at the time of validity of a fix, NED.
inline constexpr Quantity position_north{
    .name = "position.north",
    .meaning = "error of the position north; in in-flight alignment at a fix",
    .unit = metres};
inline constexpr Quantity position_east{
    .name = "position.east",
    .meaning = "error of the position east; in in-flight alignment at a fix",
    .unit = metres};
inline constexpr Quantity position_down{
    .name = "position.down",
    .meaning = "error of the position down; in in-flight alignment at a fix",
    .unit = metres};
inline constexpr Quantity velocity_down_sigma{
    .name = "velocity.down.sigma",
    .meaning = "sigma of the velocity down as the target reports it",
    .unit = mps};
inline constexpr Quantity velocity_down_over_sigma{
    .name = "velocity.down.over_sigma",
    .meaning = "ratio of the error of the velocity down to the sigma that the target reports",
    .unit = plain};
/// The number of repairs of the covariance since the start.
inline constexpr Quantity covariance_repairs{.name = "covariance.repairs",
                                             .meaning = "number of repairs of the covariance since the start",
                                             .unit = plain};

inline constexpr Quantity position_horizontal{.name = "position.horizontal",
                                              .meaning = "magnitude of the horizontal error of the position",
                                              .unit = metres};
inline constexpr Quantity position_norm{
    .name = "position.norm", .meaning = "magnitude of the error of the position", .unit = metres};
/// The innovation of a fix, NED.
inline constexpr Quantity position_innovation_north{.name = "innovation.position.north",
                                                    .meaning = "north component of the innovation of a fix",
                                                    .unit = metres,
                                                    .white = true};
inline constexpr Quantity position_innovation_east{.name = "innovation.position.east",
                                                   .meaning = "east component of the innovation of a fix",
                                                   .unit = metres,
                                                   .white = true};
inline constexpr Quantity position_innovation_down{.name = "innovation.position.down",
                                                   .meaning = "down component of the innovation of a fix",
                                                   .unit = metres,
                                                   .white = true};

}  // namespace canhil::quantities
