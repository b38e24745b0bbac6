// Reads [truth] with the trajectory "recorded" (a flight from a CSV file) or "unknown" (no flight).
#pragma once

#include "bench/world/motion.hpp"

namespace canhil::scenario {

class Section;

/// Reads the keys file, from_s, gap_s and agree_within_m. If the file has no positions, also reads the
/// position of the start: latitude_deg, longitude_deg and height_m.
world::Flight read_recorded_flight(Section& section, std::int64_t duration_us);

/// Reads only the state at the start: position, velocity and attitude.
world::Flight read_unknown_flight(Section& section);

/// `from_s`: the time in a recording at which the run begins [us]; default 0.
std::int64_t read_from_us(Section& section);

/// Reads latitude_deg, longitude_deg and height_m.
world::Position read_position(Section& section);

}  // namespace canhil::scenario
