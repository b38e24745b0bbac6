// A magnetometer of three axes, and the magnetic heading that follows from it.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [magnetometer].
struct MagnetometerSettings {
  scenario::Schedule schedule{};
  world::Vector3 field_n = world::Vector3::Zero();  ///< of the earth, NED [T]; constant along the flight
  world::RandomConstant hard_iron{};                ///< body axes [T]
  world::RandomValue scale_factor{};                ///< of all axes
  world::Vector3 noise = world::Vector3::Zero();    ///< 1-sigma of a sample, body axes [T]
  SampleLoss loss{};
};

extern const struct Kind magnetometer;

}  // namespace canhil::sensors
