// After the onset of a fault the target says that something is wrong.
#pragma once

#include "bench/checks/kinds/of_faults.hpp"

namespace canhil::checks {

struct DetectedWithin {
  static constexpr std::string_view kind = "detected_within";
  static constexpr std::string_view meaning =
      "Passes when the target gives a sign soon enough after the onset.";
  Disturbance of;
  std::int64_t within_us = 0;
  std::vector<std::string> by;  ///< names of signs; empty: any that is new

  static DetectedWithin read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return of.fault; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
