// The transmission times of a node.
#pragma once

#include <cstdint>
#include <optional>

namespace canhil::scenario {

class Section;

struct Schedule {
  std::optional<std::int64_t>
      period_us{};  ///< absent: the DBC's cycle time; present: an override, which reports must show
  std::int64_t latency_us = 0;  ///< from time of validity to the first frame of the group
  /// A further latency is drawn for each sample between 0 and this value; the order of the samples is kept.
  std::int64_t latency_spread_us = 0;
  double jitter = 0;  ///< 1-sigma of the time at which a sample is taken, about its time of validity [s]
};

/// Reads the keys period_ms and latency_ms of a node's section.
Schedule read_constant_schedule(Section& section);

/// Reads these keys, and those of the random parts of the times.
Schedule read_schedule(Section& section);

}  // namespace canhil::scenario
