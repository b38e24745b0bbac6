// Creates nodes in the same way as a run does.
#pragma once

#include <memory>

#include "bench/nodes/registry.hpp"

namespace canhil::nodes {

template <class Settings>
std::unique_ptr<Node> made(const sensors::Kind& sensor, const Settings& settings,
                           const world::FlightRecord& flight, const world::PlantRecords& plants = {}) {
  static const scenario::Scenario any;  // sensors keep a reference to their scenario
  return make({bound(sensor).table, settings},
              {.scenario = any, .index = 0, .flight = flight, .plants = plants});
}

}  // namespace canhil::nodes
