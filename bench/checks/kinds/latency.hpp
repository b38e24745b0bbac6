// Timing: the time from the last frame of a stimulus to the message that answers this stimulus.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

struct Latency {
  static constexpr std::string_view kind = "latency";
  static constexpr std::string_view meaning =
      "Timing check. Passes when the quantile of the latencies in the window is below `below_ms`.";
  std::string message;
  scenario::Window window;
  std::int64_t below_us = 0;
  double quantile = 1;  ///< 1: every answer must be below the limit; 0.99: all but one in a hundred

  static Latency read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return message; }
  [[nodiscard]] std::vector<Timed> timed() const { return {{message, window}}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

/// Reads the key "message". Its value must be a message that answers a stimulus and that an estimator of this
/// scenario sends.
std::string read_answer(scenario::Section& section, const scenario::CheckContext& context);

}  // namespace canhil::checks
