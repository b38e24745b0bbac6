// Creates nodes in the same way as a run does.
#pragma once

#include <memory>

#include "bench/nodes/kind.hpp"

namespace canhil::nodes {

template <class Settings>
std::unique_ptr<Node> made(const Kind& kind, const Settings& settings, const world::FlightRecord& flight,
                           const world::GlideRecord* glide = nullptr) {
  static const scenario::Scenario any;  // nodes keep a reference to their scenario
  return kind.make({kind.table, settings}, {.scenario = any, .index = 0, .flight = flight, .glide = glide});
}

}  // namespace canhil::nodes
