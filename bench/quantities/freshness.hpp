// How long a sample of a run stays valid.
#pragma once

#include <cstdint>
#include <limits>

namespace canhil::quantities {

/// All runs of a variant have the same freshness. By default samples never become stale.
struct Freshness {
  /// The quantities of a sample that is older than this count as missing.
  std::int64_t age_limit_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t end_us = std::numeric_limits<std::int64_t>::min();  ///< end of the flight
  /// Used only for samples by time to go (Layout::to_go_stretch_us > 0): the beginning of the flight, and the
  /// time between two samples (0: unknown).
  std::int64_t begin_us = 0, sample_us = 0;
};

}  // namespace canhil::quantities
