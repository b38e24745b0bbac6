// The vehicle's GPS receiver: positions; under water it reports no fix.
#pragma once

#include <optional>

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/fix_faults.hpp"
#include "bench/world/error_stack.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [gps].
struct GpsSettings {
  scenario::Schedule schedule{};
  world::Vector3 lever_arm =
      world::Vector3::Zero();                     ///< from the body's origin to the antenna, body axes [m]
  world::RandomConstant bias{};                   ///< NED [m]
  world::Vector3 noise = world::Vector3::Zero();  ///< 1-sigma of each fix, NED [m]
  world::TriadErrors::Stacks further{};           ///< NED [m]
  std::optional<double> lowest_height{};  ///< no valid fix below this height: the antenna is under water [m]
  FixFaults faults{};
};

extern const struct Kind gps;

}  // namespace canhil::sensors
