// Checks that no gap between heartbeats is longer than a limit, up to the end of the run. For a mapped
// target, the scenario names the message that serves as heartbeat.
#pragma once

#include "bench/checks/rule.hpp"
#include "messages/canhil.hpp"

namespace canhil::checks {

struct Heartbeat {
  static constexpr std::string_view kind = "heartbeat";
  static constexpr std::string_view meaning =
      "Passes when no gap between heartbeats is longer than `silent_at_most_s`.";
  std::string message{messages::TargetHeartbeat::info.name};
  std::int64_t silent_at_most_us = 0;

  static Heartbeat read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
