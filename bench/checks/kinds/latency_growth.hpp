// Timing: whether answers become slower during a run, for example because computing time or a queue grows.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

/// The median latency in the window's last third, divided by the median latency in its first third.
struct LatencyGrowth {
  static constexpr std::string_view kind = "latency_growth";
  static constexpr std::string_view meaning =
      "Timing check. Passes when the median latency grows by less than the factor `ratio_below` from the "
      "first third of the window to the last third.";
  std::string message;
  scenario::Window first, last;
  double ratio_below = 0;

  static LatencyGrowth read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return message; }
  [[nodiscard]] std::vector<Timed> timed() const { return {{message, first}, {message, last}}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
