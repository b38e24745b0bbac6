// The quantities that several estimators report. A quantity of one estimator is defined in that estimator's
// folder.
#pragma once

#include "bench/quantities/quantity.hpp"
#include "bench/world/units.hpp"

namespace canhil::quantities {

inline constexpr Unit mrad{"mrad", "_mrad", world::units::mrad}, degrees{"deg", "_deg", world::units::deg},
    mradps{"mrad/s", "_mradps", world::units::mrad}, mps{"m/s", "_mps"}, metres{"m", "_m"}, plain{};

/// The attitude error of the body in two forms: as Euler angles (attitude.*), and as the rotation vector phi
/// (misalignment.*), which is defined by C_estimated = exp(-[phi x]) C_true. Both forms refer to the axes
/// north, east, down (NED).
inline constexpr Quantity attitude_roll{
    .name = "attitude.roll", .meaning = "error of the roll angle", .unit = mrad};
inline constexpr Quantity attitude_pitch{
    .name = "attitude.pitch", .meaning = "error of the pitch angle", .unit = mrad};
inline constexpr Quantity attitude_heading{
    .name = "attitude.heading", .meaning = "error of the heading angle", .unit = mrad};
inline constexpr Quantity misalignment_north{
    .name = "misalignment.north",
    .meaning = "rotation from true to estimated attitude, about north",
    .unit = mrad};
inline constexpr Quantity misalignment_east{.name = "misalignment.east",
                                            .meaning = "rotation from true to estimated attitude, about east",
                                            .unit = mrad};
inline constexpr Quantity misalignment_down{.name = "misalignment.down",
                                            .meaning = "rotation from true to estimated attitude, about down",
                                            .unit = mrad};
/// The sigma of the heading that the target reports, and the heading error divided by this sigma.
inline constexpr Quantity heading_sigma{.name = "attitude.heading.sigma",
                                        .meaning = "sigma of the heading as the target reports it",
                                        .unit = mrad};
inline constexpr Quantity heading_over_sigma{
    .name = "attitude.heading.over_sigma",
    .meaning = "ratio of the heading error to the sigma that the target reports",
    .unit = plain};

/// One value for each update of the filter. It is computed from the first navigation answer that includes the
/// update.
inline constexpr Quantity heading_nees{
    .name = "attitude.heading.nees",
    .meaning = "squared ratio of the heading error to the sigma that the target reports",
    .unit = plain,
    .degrees_of_freedom = 1,
    .nan_allowed = true};

/// The error of the velocity of the body relative to the earth. Axes: north, east, down (NED).
inline constexpr Quantity velocity_north{
    .name = "velocity.north", .meaning = "error of the velocity north", .unit = mps};
inline constexpr Quantity velocity_east{
    .name = "velocity.east", .meaning = "error of the velocity east", .unit = mps};
inline constexpr Quantity velocity_down{
    .name = "velocity.down", .meaning = "error of the velocity down", .unit = mps};

/// Normalised innovation squared (NIS) of a measured velocity or a measured position. Axes: NED.
inline constexpr Quantity innovation_nis{
    .name = "innovation.nis",
    .meaning = "normalised innovation squared of a velocity or a position",
    .unit = plain,
    .degrees_of_freedom = 3,
    .white = true,
    .nan_allowed = true};

/// The magnitude of the vector of the velocity error.
inline constexpr Quantity velocity_norm{
    .name = "velocity.norm", .meaning = "magnitude of the error of the velocity", .unit = mps};

/// Of every answer, also of one that reports `degraded` or `blind`.
inline constexpr Quantity error_over_sigma{
    .name = "error.over_sigma",
    .meaning = "largest ratio of error to sigma among the judged quantities (honesty.md)",
    .unit = plain};
/// With this quantity, a check finds a target that has large errors but reports small sigmas and reports
/// neither `degraded` nor `blind`.
inline constexpr Quantity trusted_over_sigma{
    .name = "trusted.over_sigma",
    .meaning =
        "largest ratio of error to sigma among the judged quantities (honesty.md); 0 where the answer is "
        "degraded or blind",
    .unit = plain,
    .of_every_answer = &error_over_sigma};

/// Shows how often a target reports `degraded`. So a check can find a target that reports `degraded` with
/// every answer.
inline constexpr Quantity degraded{.name = "degraded",
                                   .meaning =
                                       "1 where the answer reports degraded or blind, else 0; for a "
                                       "LOS rate the share of such answers in 20 ms of the time to go",
                                   .unit = plain};

}  // namespace canhil::quantities
