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

/// The keys period_ms and latency_ms of a node's section.
Schedule read_schedule(Section& section);

/// The same for a node that samples a glide: the period of the node must be a multiple of the truth's step.
Schedule read_glide_schedule(Section& section);

}  // namespace canhil::scenario
