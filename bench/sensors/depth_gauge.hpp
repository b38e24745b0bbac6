// A depth gauge of an underwater vehicle.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [depth_gauge].
struct DepthGaugeSettings {
  scenario::Schedule schedule{};
  double surface_height = 0;          ///< of the water above the ellipsoid [m]
  double below = 0;                   ///< of the gauge below the IMU [m], along the body's z axis
  world::RandomValue scale_factor{};  ///< for example from a wrong density of the water
  world::RandomValue bias{};          ///< [m]
  double noise = 0;                   ///< 1-sigma of a sample [m]
  SampleLoss loss{};
};

extern const struct Kind depth_gauge;

}  // namespace canhil::sensors
