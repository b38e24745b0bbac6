// Timing: the target itself measures times and reports them (TargetTiming). This check compares these times
// with the latency that the bench measures.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

/// Checks two conditions. The reported times cover at least one stimulus. The sum of mean queueing time and
/// mean computing time is above 0 and not longer than the mean latency.
struct OwnTimes {
  static constexpr std::string_view kind = "own_times";
  static constexpr std::string_view meaning =
      "Timing check. Passes when the mean queueing time plus the mean computing time that the target reports "
      "(TargetTiming) is above 0 and not longer than the mean latency.";

  static OwnTimes read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
