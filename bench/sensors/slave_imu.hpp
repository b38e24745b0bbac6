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
  world::Vector3 lever_arm = world::Vector3::Zero();  ///< from the body's origin to the IMU, body axes [m]
  bool saturated_is_invalid = false;                  ///< a sample beyond the range is marked as invalid
  double loss_probability = 0;                        ///< a group is not sent, and its increments are lost
};

extern const struct Kind slave_imu;

/// The increments i of a flight record at the place of the IMU, body axes.
world::ImuIncrement increment_at_imu(const SlaveImuSettings& settings, const world::FlightRecord& flight,
                                     std::size_t i);

}  // namespace canhil::sensors
