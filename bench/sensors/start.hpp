// The start state that a device is given: position, velocity and attitude with their errors, and their
// sigmas.
#pragma once

#include "bench/scenario/schedule.hpp"

namespace canhil::sensors {

/// The table [start]. The errors are those of [initial_error].
struct StartSettings {
  scenario::Schedule schedule{};
  std::int64_t times = 1;  ///< number of samples
  /// What the device is told about the errors, 1-sigma.
  double position_sigma = 0;  ///< [m]
  double velocity_sigma = 0;  ///< [m/s]
  double tilt_sigma = 0;      ///< [rad]
  double heading_sigma = 0;   ///< [rad]
};

extern const struct Kind start;

}  // namespace canhil::sensors
