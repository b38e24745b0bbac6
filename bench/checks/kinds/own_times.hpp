// Timing: the times that the target reports itself (TargetTiming), compared with the latency that the bench
// measures.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

/// The reported queueing and computing times cover at least one stimulus and do not exceed the latencies.
struct OwnTimes {
  static constexpr std::string_view kind = "own_times";
  static constexpr std::string_view meaning =
      "Timing. Passes when the queueing and computing times that the target reports (TargetTiming) are above "
      "0 and no longer than the latencies.";

  static OwnTimes read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
