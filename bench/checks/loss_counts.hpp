// What a receiver must have counted of the frames that the bench sent (TargetCounters, docs/report.md).
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

/// More than any target counts.
inline constexpr std::uint32_t any_count = 1'000'000;

/// The limits of the counts that the target last sent. They differ where the bench cannot know how far the
/// target had read when it sent them, and where the contract lets an estimator refuse a group or use it.
struct ExpectedCounts {
  LossCounts least{}, most{};
};

}  // namespace canhil::checks
