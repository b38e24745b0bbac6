// [gps]: the vehicle's GPS receiver.
#pragma once

#include <optional>

#include "bench/scenario/fix_faults.hpp"
#include "bench/scenario/schedule.hpp"
#include "bench/world/stream.hpp"

namespace canhil::scenario {

class Section;

struct Gps {
  Schedule schedule{};
  world::RandomConstant bias{};                   ///< NED [m]
  world::Vector3 noise = world::Vector3::Zero();  ///< 1-sigma a fix, NED [m]
  std::optional<double> lowest_height{};  ///< no valid fix below this height: the antenna is under water [m]
  FixFaults faults{};
};

Gps read_gps(Section& section);

}  // namespace canhil::scenario
