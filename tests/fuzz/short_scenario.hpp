// The smallest valid scenario, for fuzzers of scenarios.
#pragma once

#include <string_view>

namespace canhil::fuzz {

inline constexpr std::string_view short_scenario = R"(title = "Short"
duration_s = 0.2
seed = 1
[target]
estimator = "transfer_alignment"
algorithm = "kalman"
initial_sigma = { velocity_mps = 1.0, tilt_deg = 1.0, heading_deg = 1.0, position_m = 10.0 }
[truth]
latitude_deg = 37.0
longitude_deg = 127.0
height_m = 1000.0
trajectory = "rest"
heading_deg = 0.0
[master_ins]
velocity_noise_mps = 0.05
[slave_imu]
accel_bias_sigma_ug = 300
accel_noise_ugprthz = 50
gyro_bias_sigma_degph = 3
gyro_noise_degprth = 0.125
[[check]]
kind = "error"
quantity = "attitude.heading"
below_mrad = 5.0
[[check]]
kind = "latency"
message = "AlignUpdate"
below_ms = 5
)";

}  // namespace canhil::fuzz
