// Limits between which the loss counters of a receiver of the bench's frames must lie (TargetCounters,
// docs/report.md).
#pragma once

#include <cstdint>

namespace canhil::checks {

/// The four counts of TargetCounters.
struct LossCounts {
  std::uint64_t frames_lost = 0;
  std::uint64_t bad_crc = 0;
  std::uint64_t bad_group = 0;
  std::uint64_t late = 0;
};

/// A limit that is larger than any count of a target.
inline constexpr std::uint32_t any_count = 1'000'000;

/// Limits for the last counts that the target sent. Lower and upper limit differ for two reasons: the bench
/// cannot see which frames the target had read when the target sent the counts, and the protocol lets the
/// estimator decide whether to use a group.
struct ExpectedCounts {
  LossCounts least{}, most{};
};

}  // namespace canhil::checks
