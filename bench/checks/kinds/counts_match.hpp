// Checks that the target's own counters (TargetCounters) agree with the frames that the bench withheld or
// damaged.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

/// Each count must lie between its limits in ExpectedCounts. A slack widens these limits on both sides.
struct CountsMatch {
  static constexpr std::string_view kind = "counts_match";
  static constexpr std::string_view meaning =
      "Passes when the target's own counters equal the counts that the bench expects. The bench computes "
      "these counts from the samples that its nodes withheld and from the frames that faults withheld or "
      "changed (report.md).";
  std::int64_t frames_lost_slack = 0, bad_crc_slack = 0, bad_group_slack = 0, late_slack = 0;

  static CountsMatch read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
