// A plant that is a program of the user: it reads commands and writes its state (docs/plant-program.md).
#pragma once

#include "bench/plant/plant.hpp"

namespace canhil::plant {

extern const Kind program;

}  // namespace canhil::plant
