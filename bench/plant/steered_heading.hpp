// A ship or a car on a level surface: a rudder or a steering actuator turns its heading.
#pragma once

#include "bench/plant/plant.hpp"

namespace canhil::plant {

extern const Kind steered_heading;

}  // namespace canhil::plant
