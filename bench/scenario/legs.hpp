// Reads the trajectories "legs" and "waypoints" of [truth]: the vehicle, and what it does on each
// [[truth.leg]], or the [[truth.waypoint]]s by which it passes.
#pragma once

#include "bench/world/motion.hpp"

namespace canhil::scenario {

class Section;

/// Reads the vehicle, its speed and the waypoints, for a flight that begins at `start`.
world::Motion read_waypoints(Section& section, const world::Position& start);

/// Reads the vehicle, the state at the start and the legs.
world::Motion read_legs(Section& section);

}  // namespace canhil::scenario
