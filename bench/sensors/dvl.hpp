// A Doppler velocity log (DVL): the velocity of the vehicle relative to the ground, in body axes.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [dvl].
struct DvlSettings {
  scenario::Schedule schedule{};
  world::RandomValue scale_factor{};              ///< of all axes
  world::RandomConstant bias{};                   ///< body axes [m/s]
  world::Vector3 noise = world::Vector3::Zero();  ///< 1-sigma of a sample, body axes [m/s]
  double invalid_probability = 0;                 ///< of a sample without bottom lock
  SampleLoss loss{};
};

extern const struct Kind dvl;

}  // namespace canhil::sensors
