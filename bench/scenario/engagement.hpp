// Reads [engagement]: missile, target and guidance, instead of the carrier of [truth] or in addition to it.
#pragma once

#include "bench/world/engagement/plan.hpp"

namespace canhil::scenario {

class Section;

/// Every key except `guidance` has a default: the engagement of world/engagement/plan.hpp.
world::EngagementPlan read_engagement(Section& section);

}  // namespace canhil::scenario
