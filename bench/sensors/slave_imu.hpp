// The IMU of the weapon to be aligned: at every epoch of the flight record, the exact increments plus the
// errors of the sensor.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/world/imu_errors.hpp"

namespace canhil::sensors {

/// The table [slave_imu].
struct SlaveImuSettings {
  scenario::Schedule schedule{};
  world::ImuErrorModel errors{};
  double loss_probability = 0;  ///< a group is not sent, and its increments are lost
};

extern const struct Kind slave_imu;

}  // namespace canhil::sensors
