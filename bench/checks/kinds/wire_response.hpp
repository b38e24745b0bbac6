// Checks that no frame takes longer over the bus than its theoretical worst case. The check needs a bus of
// known bit rate.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

struct WireResponseRule {
  static constexpr std::string_view kind = "wire_response";
  static constexpr std::string_view meaning =
      "Passes when the response time of every frame is within the bound that the bench computes for the "
      "message (report.md). Needs a bus whose bit rate is known.";

  static WireResponseRule read(scenario::Section& /*section*/, const scenario::CheckContext& /*context*/) {
    return {};
  }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
