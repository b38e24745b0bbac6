// How long a sample of a run stays valid.
#pragma once

#include <cstdint>
#include <limits>

namespace canhil::quantities {

/// All runs of a variant have the same freshness. By default samples never become stale.
struct Freshness {
  /// If a sample is older than age_limit_us, its quantities are treated as missing.
  std::int64_t age_limit_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t end_us = std::numeric_limits<std::int64_t>::min();  ///< end of the flight
  /// The beginning of the flight, and the time between two samples (0: unknown). Both are used only if a
  /// sample covers an interval of the time to go (Layout::to_go_stretch_us > 0).
  std::int64_t begin_us = 0, sample_us = 0;
};

}  // namespace canhil::quantities
