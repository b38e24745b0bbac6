// Actions on the process of a target that the bench has started.
#pragma once

#include "bench/faults/rule.hpp"

namespace canhil::faults {

/// The process is stopped by SIGSTOP and continued later.
struct Paused {
  static constexpr std::string_view kind = "paused";
  static constexpr std::string_view meaning =
      "The target's process is stopped (SIGSTOP) and, after `for_s`, continued. Needs `for_s`.";
  static constexpr Stage stage = Stage::target;
  When when{};
  static Paused read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string cannot(const Place& place) const;
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The process gets only a fraction of the CPU time: it is stopped for the rest of each period.
struct Slowed {
  static constexpr std::string_view kind = "slowed";
  static constexpr std::string_view meaning =
      "In each period the target's process runs for `cpu_percent` of the time and is stopped for the rest.";
  static constexpr Stage stage = Stage::target;
  When when{};
  double share = 1;
  std::int64_t period_us = 0;
  static Slowed read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string cannot(const Place& place) const;
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

/// The process is killed, started again and initialised with the state at the time of the restart. Until the
/// new process has been initialised, the bench sends nothing else.
struct Restarted {
  static constexpr std::string_view kind = "restarted";
  static constexpr std::string_view meaning =
      "The target's process is killed and started again. The bench then repeats the handshake. The initial "
      "state that the bench sends is the true state at the time of the restart, with the same initial errors "
      "as at the start of the run.";
  static constexpr Stage stage = Stage::target;
  When when{};
  static Restarted read(scenario::Section& section, const scenario::FaultContext& context);
  [[nodiscard]] std::string cannot(const Place& place) const;
  [[nodiscard]] std::unique_ptr<Injector> injector(const InRun& run) const;
};

}  // namespace canhil::faults
