// A small rotorcraft in the air: thrust and body rates steer its attitude, velocity and position.
#pragma once

#include "bench/plant/plant.hpp"

namespace canhil::plant {

extern const Kind hover;

}  // namespace canhil::plant
