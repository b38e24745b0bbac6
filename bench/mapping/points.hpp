// The errors of a mapped target's quantities over a run.
#pragma once

#include "bench/mapping/answers.hpp"

namespace canhil::mapping {

struct Points {
  Spool<quantities::TrackPoint> points;
  Spool<std::int64_t> without_truth;  ///< times of the answers at which the truth has no value
};

/// The points of a quantity, reported or derived, in order of time. A sigma or
/// a correlation may come in another message than the value: the latest one at or before the value is used,
/// unless its message has been silent since. A derived quantity has a point for each value of the last of its
/// parts, with the latest values of the others.
Points points_of(const ReferenceQuantity& of, const MappedTarget& target, const checks::Observations& seen,
                 const estimators::Truth& truth);

/// The number of pages of a multiplexed message, which come in turn; 1 for any other.
double pages_of(const Hear& hear);
/// The longest time [us] between the values of a signal in this message that does not count as silence.
double longest_wait_us(const checks::Observations& seen, const Hear& hear);

/// The message that carries a quantity which the target reports.
const Hear& hear_of(const MappedTarget& target, const quantities::Quantity* quantity);

}  // namespace canhil::mapping
