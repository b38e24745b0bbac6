// Checks that the target reports a sign of trouble soon after the onset of a fault.
#pragma once

#include "bench/checks/kinds/of_faults.hpp"

namespace canhil::checks {

struct DetectedWithin {
  static constexpr std::string_view kind = "detected_within";
  static constexpr std::string_view meaning =
      "Passes when the target reports a sign of trouble within `within_s` after the onset of the fault "
      "(scenarios.md defines the signs).";
  Disturbance disturbance;
  std::int64_t within_us = 0;
  std::vector<std::string> by;  ///< names of signs; empty: any new sign

  static DetectedWithin read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return disturbance.fault; }
  [[nodiscard]] std::optional<std::int64_t> event_us() const { return disturbance.event_us(); }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
