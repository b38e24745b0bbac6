// Reads [glide], [wind] and [airframe]: a glider. Each run has its own flight, because errors are drawn for
// each run. [wind] is required, [airframe] is optional.
#pragma once

#include "bench/scenario/plant_facts.hpp"

namespace canhil::plant::glide {

extern const scenario::PlantTable table;

}  // namespace canhil::plant::glide
