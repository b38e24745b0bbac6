// Reads [initial_error]: the errors of the initial state that the target receives.
#pragma once

#include "bench/world/navigation_errors.hpp"

namespace canhil::scenario {

class Section;

world::InitialErrorModel read_initial_error(Section& section);

}  // namespace canhil::scenario
