// For how long a sample of a run stands for what follows it.
#pragma once

#include <cstdint>
#include <limits>

namespace canhil::quantities {

/// The same for all runs of a variant. By default nothing is ever stale.
struct Freshness {
  /// A sample older than this is stale, and what it says of that time is missing.
  std::int64_t age_limit_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t end_us = std::numeric_limits<std::int64_t>::min();  ///< of the flight
  /// Of samples by time to go: when the flight begins, and from one sample to the next; 0: not known.
  std::int64_t begin_us = 0, sample_us = 0;
};

}  // namespace canhil::quantities
