// How an engagement ended: shared by the estimators whose answers may guide the missile.
#pragma once

#include <cstdint>

#include "bench/checks/results.hpp"
#include "bench/world/engagement/engagement.hpp"

namespace canhil::estimators {

/// A result line: the closest approach, its time, and how many answers came too late to guide.
ResultLine end_of_flight(const world::EngagementRecord& engagement);
/// The time [us] after which no sample needs an answer: the passage, if the missile passed its target.
std::int64_t answers_end_us(const world::EngagementRecord& engagement, std::int64_t duration_us);

}  // namespace canhil::estimators
