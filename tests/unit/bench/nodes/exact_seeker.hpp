// A seeker without errors.
#pragma once

#include "bench/sensors/seeker_errors.hpp"

namespace canhil::sensors {

inline constexpr SeekerErrorModel exact_seeker{.thermal = 0,
                                               .glint = 0,
                                               .gyro_noise = 0,
                                               .gyro_bias = {},
                                               .accel_noise = 0,
                                               .accel_bias = {},
                                               .range_noise = 0,
                                               .range_bias = {},
                                               .closing_speed_noise = 0,
                                               .closing_speed_bias = {}};

}  // namespace canhil::sensors
