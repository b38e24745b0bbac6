// [truth]: where the carrier starts and how it moves. A new motion is a reader in truth.cpp and a line in its
// table; one that is flown from a recording, or unknown, is in recorded_flight.cpp.
#pragma once

#include "bench/world/motion.hpp"

namespace canhil::scenario {

class Section;

world::Flight read_truth(Section& section, std::int64_t duration_us);

}  // namespace canhil::scenario
