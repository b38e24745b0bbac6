// Quantities that only the estimator of baro-inertial height reports.
#pragma once

#include "bench/quantities/list.hpp"

namespace canhil::quantities {

inline constexpr Quantity height{.name = "height", .meaning = "error of the height", .unit = metres};
inline constexpr Quantity height_sigma{
    .name = "height.sigma", .meaning = "sigma of the height as the target reports it", .unit = metres};
inline constexpr Quantity height_nees{
    .name = "height.nees",
    .meaning = "squared ratio of the height error to the sigma that the target reports",
    .unit = plain,
    .degrees_of_freedom = 1};
inline constexpr Quantity height_nis{.name = "height.nis",
                                     .meaning = "normalised innovation squared of a barometric height",
                                     .unit = plain,
                                     .degrees_of_freedom = 1,
                                     .white = true};

}  // namespace canhil::quantities
