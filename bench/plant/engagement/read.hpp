// Reads [engagement]: missile, target and guidance. A scenario has this table instead of [truth] (the flight
// of a carrier) or in addition to it.
#pragma once

#include "bench/plant/engagement/settings.hpp"
#include "bench/scenario/plant_facts.hpp"

namespace canhil::plant::engagement {

/// Every key except `guidance` has a default: the value in settings.hpp.
extern const scenario::PlantTable table;

/// What a scenario knows of an engagement.
scenario::PlantFacts facts_of(const Settings& settings);

}  // namespace canhil::plant::engagement
