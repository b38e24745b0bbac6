// Reads [engagement]: missile, target and guidance. This table replaces the carrier of [truth] or is added to
// it.
#pragma once

#include "bench/world/engagement/plan.hpp"

namespace canhil::scenario {

class Section;

/// Every key except `guidance` has a default: the value in world/engagement/plan.hpp.
world::EngagementPlan read_engagement(Section& section);

}  // namespace canhil::scenario
