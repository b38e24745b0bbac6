// Acoustic positioning from a moving reference ship: the vehicle's position relative to the ship, and the
// ship's reported position.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/fix_faults.hpp"
#include "bench/world/error_stack.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [ssbl].
struct SsblSettings {
  scenario::Schedule schedule{};
  world::Vector3 ship_offset =
      world::Vector3::Zero();  ///< ship relative to the vehicle at the start, NED [m]
  world::Vector3 ship_velocity = world::Vector3::Zero();  ///< constant, NED [m/s]
  world::RandomConstant ship_error{};  ///< error of the position that the ship reports, NED [m]
  world::RandomConstant bias{};        ///< error of the relative position, NED [m]
  world::Vector3 noise =
      world::Vector3::Zero();            ///< 1-sigma of each relative position at zero range, NED [m]
  double range_noise = 0;                ///< 1-sigma per fix and component, divided by the slant range
  world::TriadErrors::Stacks further{};  ///< NED [m]
  FixFaults faults{};
};

extern const struct Kind ssbl;

}  // namespace canhil::sensors
