// Reads [truth]: the start and the motion of the carrier. A new motion needs a reader and a line in the table
// of truth.cpp; recorded_flight.cpp reads a recorded or an unknown flight.
#pragma once

#include "bench/world/motion.hpp"

namespace canhil::scenario {

class Section;

/// Reads heading_deg [rad].
double read_heading(Section& section);

/// `plant_moves`: the scenario has a plant that moves the carrier.
world::Flight read_truth(Section& section, std::int64_t duration_us, bool plant_moves = false);

}  // namespace canhil::scenario
