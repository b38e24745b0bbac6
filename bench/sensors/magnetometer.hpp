// A magnetometer of three axes, and the magnetic heading that follows from it.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/error_stack.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [magnetometer].
struct MagnetometerSettings {
  scenario::Schedule schedule{};
  world::Vector3 field_n = world::Vector3::Zero();    ///< of the earth, NED [T]; constant along the flight
  world::RandomConstant hard_iron{};                  ///< body axes [T]
  world::Matrix3 soft_iron = world::Matrix3::Zero();  ///< field by magnetisable parts per field, body axes
  world::RandomConstant mounting{};                   ///< roll, pitch and yaw of its axes in the body [rad]
  world::RandomValue scale_factor{};                  ///< of all axes
  world::Vector3 noise = world::Vector3::Zero();      ///< 1-sigma of a sample, its own axes [T]
  world::TriadErrors::Stacks further{};               ///< its own axes [T]
  SampleLoss loss{};
};

extern const struct Kind magnetometer;

}  // namespace canhil::sensors
