// Constant errors of a sensor, which are drawn for each run.
#pragma once

#include <string_view>

#include "bench/scenario/section.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// Reads the key of a constant error, such as `bias_m`, and the key `bias_sigma_m`, the 1-sigma of a further
/// error that is drawn for each run and added. `of`: what has the error, for the reference: "the depth".
world::RandomValue read_constant(scenario::Section& section, std::string_view key, std::string_view of,
                                 double usual_sigma = 0);
/// The same for three axes.
world::RandomConstant read_constants(scenario::Section& section, std::string_view key, std::string_view of);

/// Reads the keys of the mounting of a sensor's axes in the body: roll, pitch and yaw [rad]. `of`: "the IMU".
world::RandomConstant read_mounting(scenario::Section& section, std::string_view of);
/// Reads the key of the place of a sensor in the body: from the body's origin, body axes [m]. `what`: "the
/// IMU".
world::Vector3 read_lever_arm(scenario::Section& section, std::string_view what);

}  // namespace canhil::sensors
