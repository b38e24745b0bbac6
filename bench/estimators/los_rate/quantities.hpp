// Quantities of the line-of-sight rate.
#pragma once

#include <array>

#include "bench/quantities/list.hpp"

namespace canhil::quantities {

/// The errors of the LOS rate in the axes of the antenna. los_rate_both is the RMS of the errors in the two
/// planes.
inline constexpr Quantity los_rate_pitch{
    .name = "los.rate.pitch",
    .meaning = "error of the LOS rate in pitch, antenna axes; in campaigns RMS over 20 ms of the time to go",
    .unit = mradps,
    .has_time_to_go = true};
inline constexpr Quantity los_rate_yaw{
    .name = "los.rate.yaw",
    .meaning = "error of the LOS rate in yaw, antenna axes; in campaigns RMS over 20 ms of the time to go",
    .unit = mradps,
    .has_time_to_go = true};
inline constexpr std::array<const Quantity*, 2> los_rate_planes{&los_rate_pitch, &los_rate_yaw};
inline constexpr Quantity los_rate_both{
    .name = "los.rate",
    .meaning = "error of the LOS rate: RMS over both planes and over 20 ms of the time to go",
    .unit = mradps,
    .has_time_to_go = true,
    .parts = los_rate_planes};
/// The reported sigma, RMS of both planes.
inline constexpr Quantity los_rate_sigma{.name = "los.rate.sigma",
                                         .meaning =
                                             "sigma of the LOS rate as the target reports it: RMS over both "
                                             "planes and over 20 ms of the time to go",
                                         .unit = mradps};
inline constexpr Quantity los_rate_over_sigma{.name = "los.rate.over_sigma",
                                              .meaning =
                                                  "ratio of the error of the LOS rate to its sigma: RMS over "
                                                  "both planes and over 20 ms of the time to go",
                                              .unit = plain};
/// The mean NIS (2 degrees of freedom) of the updates in a stretch of 20 ms of the time to go. NaN: the
/// stretch has no update.
inline constexpr Quantity los_mean_nis{
    .name = "los.nis.mean",
    .meaning = "mean NIS of the updates (2 degrees of freedom each) in 20 ms of the time to go",
    .unit = plain,
    .nan_allowed = true};
/// The components of the miss vector in axes that do not rotate: x is the direction of the line of sight at
/// the start of the run. NaN: the missile did not pass the target.
inline constexpr Quantity miss_pitch{
    .name = "miss.pitch",
    .meaning = "component of the miss in the pitch plane, in the axes at the start of the run",
    .unit = metres,
    .of_whole_run = true};
inline constexpr Quantity miss_yaw{
    .name = "miss.yaw",
    .meaning = "component of the miss in the yaw plane, in the axes at the start of the run",
    .unit = metres,
    .of_whole_run = true};
inline constexpr Quantity miss_distance{.name = "miss.distance",
                                        .meaning = "closest approach in both planes",
                                        .unit = metres,
                                        .of_whole_run = true};

/// The NIS of one update.
inline constexpr Quantity los_nis{.name = "los.nis",
                                  .meaning = "normalised innovation squared of an update",
                                  .unit = plain,
                                  .degrees_of_freedom = 2,
                                  .white = true,
                                  .nan_allowed = true,
                                  .has_time_to_go = true};

}  // namespace canhil::quantities
