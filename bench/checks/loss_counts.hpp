// Limits for the counts in TargetCounters (docs/report.md). With this message a target reports how many
// losses and defects it found in the bench's frames.
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

/// Limits for the last counts that the target sent. The lower limit differs from the upper limit for two
/// reasons. The bench cannot see which frames the target had read when the target sent the counts. The
/// protocol lets the estimator decide whether to use a group.
struct ExpectedCounts {
  LossCounts least{}, most{};
};

}  // namespace canhil::checks
