#pragma once
// The airframe that is compiled in: a 500-lb body with a planar wing kit. Replace it here to use another
// airframe. These are not the data of a real weapon: the size is that of the Mk-82 class, and all
// coefficients are textbook estimates.
#include "target/estimators/wind/airframe.hpp"

namespace canhil::wind {

// clang-format off
/// The airframe of the filter. The simulated glider has the same airframe except for what a scenario changes.
inline constexpr Airframe airframe_table{
    .mass = 300,
    .Ixx = 8, .Iyy = 120, .Izz = 125, .Ixz = 0.5,
    .area = 0.65, .span = 2.6, .chord = 0.25,
    .lift  = {.constant = 0.10, .alpha =  5.50, .pitch_rate =   6.0, .elevator =  0.40},
    .pitch = {.constant = 0.06, .alpha = -1.50, .pitch_rate = -27.0, .elevator = -1.80},
    .side  = {.sideslip = -0.90,  .roll_rate =  0.00, .yaw_rate =  0.35, .aileron =  0.000, .rudder =  0.25},
    .roll  = {.sideslip = -0.05,  .roll_rate = -0.50, .yaw_rate =  0.10, .aileron =  0.080, .rudder =  0.01},
    .yaw   = {.sideslip =  0.080, .roll_rate = -0.03, .yaw_rate = -0.25, .aileron = -0.005, .rudder = -0.10},
    .drag  = {.constant = 0.070, .lift_squared = 0.050, .sideslip_squared = 0.50, .deflection_squared = 0.30,
              .wave = 0.03, .wave_mach = 0.92, .wave_width = 0.04},
    .mach_squared = 0.30,
    .alpha = {-0.26, 0.35},         // -15 to 20 deg
    .beta = {-0.26, 0.26},          // 15 deg
    .speed = {60, 340},
    .mach_most = 1.0,
    .altitude = {-500, 20'000},
    .pitch_most = 1.48,             // 85 deg
    .deflection_most = 0.367,       // fin limit of 20 deg plus rigging error of 1 deg
};
// clang-format on

}  // namespace canhil::wind
