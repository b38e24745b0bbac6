// [engagement]: missile, target and guidance, in place of the carrier of [truth] or beside it.
#pragma once

#include "bench/world/engagement/plan.hpp"

namespace canhil::scenario {

class Section;

/// Every key has a default but `guidance`: the engagement of world/engagement/plan.hpp.
world::EngagementPlan read_engagement(Section& section);

}  // namespace canhil::scenario
