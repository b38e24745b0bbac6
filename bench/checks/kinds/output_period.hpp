// Timing: the time between successive frames of a message differs from the period of the message by at most a
// given fraction of this period.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

struct OutputPeriod {
  static constexpr std::string_view kind = "output_period";
  static constexpr std::string_view meaning =
      "Timing check. Passes when the quantile of the deviations from the message's period is within "
      "`within_percent`.";
  std::string message;
  scenario::Window window;
  double within = 0;    ///< fraction of the period: 0.1 is 10 %
  double quantile = 1;  ///< 1: every interval must be within the limit; 0.99: all but one in a hundred

  static OutputPeriod read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return message; }
  [[nodiscard]] std::vector<Timed> timed() const { return {{message, window}}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

/// Rejects `message` if no running estimator sends it.
void expect_sent(scenario::Section& section, const scenario::CheckContext& context,
                 const std::string& message);

}  // namespace canhil::checks
