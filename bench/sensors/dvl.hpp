// A Doppler velocity log (DVL): its velocity relative to the ground, along its own axes.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [dvl].
struct DvlSettings {
  scenario::Schedule schedule{};
  world::Vector3 lever_arm = world::Vector3::Zero();  ///< from the body's origin to the DVL, body axes [m]
  world::RandomConstant mounting{};                   ///< roll, pitch and yaw of its axes in the body [rad]
  world::RandomValue scale_factor{};                  ///< of all axes
  world::RandomConstant bias{};                       ///< the DVL's axes [m/s]
  world::Vector3 noise = world::Vector3::Zero();      ///< 1-sigma of a sample, the DVL's axes [m/s]
  double invalid_probability = 0;                     ///< of a sample without bottom lock
  SampleLoss loss{};
};

extern const struct Kind dvl;

}  // namespace canhil::sensors
