// A plant that is an FMU (Functional Mock-up Unit) for co-simulation, FMI 2.0 or 3.0: docs/fmu.md.
#pragma once

#include "bench/plant/plant.hpp"

namespace canhil::plant {

extern const Kind fmu_plant;

}  // namespace canhil::plant
