// The IMU of the weapon to be aligned. Sends the group SlaveImu at every epoch of the flight record: exact
// increments, its errors, and what the bus makes of them.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/world/imu_errors.hpp"

namespace canhil::nodes {

/// The table [slave_imu].
struct SlaveImuSettings {
  scenario::Schedule schedule{};
  world::ImuErrorModel errors{};
  double loss_probability = 0;  ///< of each group: not sent, its increments are gone
};

extern const struct Kind slave_imu;

}  // namespace canhil::nodes
