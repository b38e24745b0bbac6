// The kinds of plants.
#pragma once

#include <span>

#include "bench/plant/plant.hpp"
#include "bench/scenario/plant_facts.hpp"

namespace canhil::plant {

/// The kinds of the table [plant].
std::span<const Kind* const> kinds();
/// The plants with tables of their own, in the order in which a scenario is read.
std::span<const scenario::PlantTable* const> tables();

}  // namespace canhil::plant
