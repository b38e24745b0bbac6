// [slave_imu]: the IMU of the weapon to be aligned.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/world/imu_errors.hpp"

namespace canhil::scenario {

class Section;

struct SlaveImu {
  Schedule schedule{};
  world::ImuErrorModel errors{};
  double loss_probability = 0;  ///< of each group: not sent, its increments are gone
};

SlaveImu read_slave_imu(Section& section);

}  // namespace canhil::scenario
