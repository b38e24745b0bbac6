// What befalls the fixes of an aiding node on their way.
#pragma once

#include "bench/scenario/fix_faults.hpp"
#include "bench/world/stream.hpp"

namespace canhil::nodes {

/// What became of one fix.
struct Fate {
  bool lost = false;                             ///< its group is not sent
  bool invalid = false;                          ///< sent, but flagged
  world::Vector3 jump = world::Vector3::Zero();  ///< of an outlier: horizontal, in any direction [m]
};

/// Draws the fate of the fix at a time. Takes four numbers of the stream, whatever the faults are.
Fate draw_fate(const scenario::FixFaults& faults, std::int64_t valid_us, world::Stream& stream);

}  // namespace canhil::nodes
