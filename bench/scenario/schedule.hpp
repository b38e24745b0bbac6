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
};

/// Reads the keys period_ms and latency_ms of a node's section.
Schedule read_schedule(Section& section);

/// Reads the keys period_ms and latency_ms of a node that samples a glide. The period of the node must be a
/// multiple of the step of the truth.
Schedule read_glide_schedule(Section& section);

}  // namespace canhil::scenario
