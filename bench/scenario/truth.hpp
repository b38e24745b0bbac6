// [truth]: where the carrier starts and how it moves. A new motion is a reader in truth.cpp and a line in its
// table.
#pragma once

#include "bench/world/motion.hpp"

namespace canhil::scenario {

class Section;

world::Flight read_truth(Section& section);

}  // namespace canhil::scenario
