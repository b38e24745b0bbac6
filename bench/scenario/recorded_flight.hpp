// [truth] of trajectory "recorded": a flight that was flown, of a CSV file; and "unknown": none.
#pragma once

#include "bench/world/motion.hpp"

namespace canhil::scenario {

class Section;

/// The keys file, from_s, gap_s and agree_within_m, and latitude_deg, longitude_deg and height_m of the start
/// where the file has no positions.
world::Flight read_recorded_flight(Section& section, std::int64_t duration_us);

/// The start alone: position, velocity and attitude.
world::Flight read_unknown_flight(Section& section);

/// `from_s`: the time of a recording at which the run begins; 0 by default [us].
std::int64_t read_from_us(Section& section);

/// latitude_deg, longitude_deg and height_m.
world::Position read_position(Section& section);

}  // namespace canhil::scenario
