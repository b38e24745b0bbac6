// The wheel speeds of a road vehicle.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [wheels].
struct WheelsSettings {
  scenario::Schedule schedule{};
  double track = 1.5;                 ///< distance of the left from the right wheels [m]
  world::RandomValue scale_factor{};  ///< of all wheels: the radius is wrong
  double noise = 0;                   ///< 1-sigma of a sample [m/s]
  bool with_sign = false;             ///< a wheel that turns backwards has a negative speed
  SampleLoss loss{};
};

extern const struct Kind wheels;

}  // namespace canhil::sensors
