// For how long a sample of a run stands for what follows it.
#pragma once

#include <cstdint>
#include <limits>

namespace canhil::scenario {
struct Scenario;
}

namespace canhil::campaign {

/// The same for all runs of a variant. Of family los_rate times are minus the time to go. By default nothing
/// is ever stale.
struct Freshness {
  /// A sample older than this is stale, and what it says of that time is missing.
  std::int64_t age_limit_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t end_us = std::numeric_limits<std::int64_t>::min();  ///< of the flight
  /// Of family los_rate: when the flight begins, and from one sample to the next; 0: not known.
  std::int64_t begin_us = 0, sample_us = 0;
};

/// By the rule of the checks (bench/checks/silence.hpp). Fixes may be lost on purpose: those that the
/// scenario loses at random (loss_percent, invalid_percent) make nothing stale; its silences do.
Freshness freshness_of(const scenario::Scenario& scenario);

}  // namespace canhil::campaign
