// The options --realtime, --priority and --cpu, which are the same for hil-bench and hil-target.
#pragma once

#include <optional>
#include <string>

#include "dbc/command_line/command_line.hpp"
#include "dbc/realtime/process.hpp"

namespace canhil::realtime {

/// The values that the user typed.
struct Options {
  bool wanted = false;
  std::optional<int> priority;
  std::optional<int> cpu;

  /// The argument for enter(); nullopt: --realtime was not given.
  [[nodiscard]] std::optional<Request> request() const {
    if (!wanted) return std::nullopt;
    return Request{.priority = priority.value_or(default_priority), .cpu = cpu};
  }
};

/// Adds the three options to `command`. `options` must outlive the command. Returns the option --realtime.
inline command_line::Option add_options(command_line::Command command, Options& options) {
  const auto realtime = command.add_flag(
      "--realtime", options.wanted,
      "run under SCHED_FIFO with all memory locked; if that is not permitted, print the remedy and end");
  command
      .add_number("--priority", options.priority,
                  "of --realtime (default " + std::to_string(default_priority) + ")", 1, 99)
      .needs(realtime);
  command.add_number("--cpu", options.cpu, "the only CPU to run on, with --realtime", 0, 1023)
      .needs(realtime);
  return realtime;
}

}  // namespace canhil::realtime
