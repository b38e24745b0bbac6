// The kinds of plants.
#pragma once

#include <span>

#include "bench/plant/plant.hpp"

namespace canhil::plant {

std::span<const Kind* const> kinds();

}  // namespace canhil::plant
