// Reads [truth]: where the carrier starts and how it moves. A new motion needs a reader in truth.cpp and a
// line in its table; a recorded or unknown flight is in recorded_flight.cpp.
#pragma once

#include "bench/world/motion.hpp"

namespace canhil::scenario {

class Section;

world::Flight read_truth(Section& section, std::int64_t duration_us);

}  // namespace canhil::scenario
