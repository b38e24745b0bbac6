// Reads [engagement]: missile, target and guidance. A scenario has this table instead of [truth] (the flight
// of a carrier) or in addition to it.
#pragma once

#include "bench/world/engagement/plan.hpp"

namespace canhil::scenario {

class Section;

/// Every key except `guidance` has a default: the value in world/engagement/plan.hpp.
world::EngagementPlan read_engagement(Section& section);

}  // namespace canhil::scenario
