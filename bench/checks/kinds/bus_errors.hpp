// Errors of the bus itself. If a scenario does not contain this check, any bus-off or outage makes the run
// fail.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

/// Limits of the counts. For bus-offs and outages the limit is 0 if the scenario gives none. All other counts
/// are judged only if the scenario gives a limit.
struct BusErrorLimits {
  static constexpr std::string_view kind = "bus_errors";
  static constexpr std::string_view meaning =
      "Passes when each count of bus errors is within its limit. A count without a limit is not judged; "
      "bus-offs and outages have the limit 0 if none is given.";
  std::int64_t bus_off_at_most = 0;
  std::int64_t down_at_most = 0;  ///< outages of the bench's interface
  std::optional<std::int64_t> passive_at_most{}, warning_at_most{}, error_frames_at_most{};
  std::optional<std::int64_t> late_in_queue_at_most{};  ///< frames of the bench that were late in the queue

  static BusErrorLimits read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
