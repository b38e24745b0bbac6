// [initial_error]: how wrong the state is that the target is told at the start.
#pragma once

#include "bench/world/navigation_errors.hpp"

namespace canhil::scenario {

class Section;

world::InitialErrorModel read_initial_error(Section& section);

}  // namespace canhil::scenario
