// Quantities that a mapped target may report besides those of the bench's own estimators.
#pragma once

#include "bench/quantities/list.hpp"

namespace canhil::quantities {

inline constexpr Unit degps{"deg/s", "_degps", world::units::deg}, mps2{"m/s^2", "_mps2"};

/// Angular rate of the body relative to inertial space, in body axes.
inline constexpr Quantity rate_x{
    .name = "rate.x", .meaning = "error of the inertial rate about x", .unit = degps};
inline constexpr Quantity rate_y{
    .name = "rate.y", .meaning = "error of the inertial rate about y", .unit = degps};
inline constexpr Quantity rate_z{
    .name = "rate.z", .meaning = "error of the inertial rate about z", .unit = degps};
/// Specific force (acceleration minus gravity), in body axes.
inline constexpr Quantity specific_force_x{
    .name = "specific_force.x", .meaning = "error of the specific force along x", .unit = mps2};
inline constexpr Quantity specific_force_y{
    .name = "specific_force.y", .meaning = "error of the specific force along y", .unit = mps2};
inline constexpr Quantity specific_force_z{
    .name = "specific_force.z", .meaning = "error of the specific force along z", .unit = mps2};
/// Velocity over ground in body axes, its horizontal magnitude, and the direction of the motion.
inline constexpr Quantity velocity_x{
    .name = "velocity.x", .meaning = "error of the velocity along the body's x axis", .unit = mps};
inline constexpr Quantity velocity_y{
    .name = "velocity.y", .meaning = "error of the velocity along the body's y axis", .unit = mps};
inline constexpr Quantity velocity_z{
    .name = "velocity.z", .meaning = "error of the velocity along the body's z axis", .unit = mps};
inline constexpr Quantity ground_speed{
    .name = "ground_speed", .meaning = "error of the horizontal speed over ground", .unit = mps};
inline constexpr Quantity course{
    .name = "course",
    .meaning = "error of the course over ground, which has no truth below 0.1 m/s",
    .unit = degrees};
inline constexpr Quantity position_latitude{
    .name = "position.latitude", .meaning = "error of the geodetic latitude", .unit = mrad};
inline constexpr Quantity position_longitude{
    .name = "position.longitude", .meaning = "error of the longitude", .unit = mrad};
inline constexpr Quantity position_height{
    .name = "position.height", .meaning = "error of the height above the ellipsoid", .unit = metres};

/// The normalised error squared e^T P^-1 e, where P has the sigmas and correlations that the target reports.
inline constexpr Quantity velocity_nees{
    .name = "velocity.nees",
    .meaning = "normalised error squared of the velocity, with sigmas and correlations as reported",
    .unit = plain,
    .degrees_of_freedom = 3,
    .nan_allowed = true};
inline constexpr Quantity position_nees{
    .name = "position.nees",
    .meaning = "normalised error squared of the position, with sigmas and correlations as reported",
    .unit = plain,
    .degrees_of_freedom = 3,
    .nan_allowed = true};
inline constexpr Quantity position_horizontal_nees{
    .name = "position.horizontal.nees",
    .meaning =
        "normalised error squared of the horizontal position, with sigmas and correlations as reported",
    .unit = plain,
    .degrees_of_freedom = 2,
    .nan_allowed = true};
/// The normalised innovation squared, with the sigmas and correlations that the target reports.
inline constexpr Quantity velocity_nis{.name = "innovation.velocity.nis",
                                       .meaning = "normalised innovation squared of a velocity",
                                       .unit = plain,
                                       .degrees_of_freedom = 3,
                                       .white = true,
                                       .nan_allowed = true};
inline constexpr Quantity position_nis{.name = "innovation.position.nis",
                                       .meaning = "normalised innovation squared of a position",
                                       .unit = plain,
                                       .degrees_of_freedom = 3,
                                       .white = true,
                                       .nan_allowed = true};

}  // namespace canhil::quantities
