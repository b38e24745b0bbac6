// The shell commands of a scenario around its flight: power, reset, relays.
#pragma once

#include <atomic>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::scenario {
struct Scenario;
}

namespace canhil::drive {

/// Runs `after` whenever `before` was begun, however the run ends. An empty command does nothing.
class RigCommands {
 public:
  RigCommands(std::string before, std::string after) : before_(std::move(before)), after_(std::move(after)) {}
  RigCommands(const RigCommands&) = delete;
  RigCommands& operator=(const RigCommands&) = delete;
  ~RigCommands() { finish(); }

  /// Runs `before` to its end; if `stop` becomes true, ends the command and the processes that it started.
  /// Error: it did not exit with 0, or it was interrupted.
  Result<void> begin(const std::atomic<bool>& stop);
  /// Runs `after` to its end, also if the run was interrupted, unless begin() was not called or `after` has
  /// run already. If it does not exit with 0, prints a line.
  void finish();

 private:
  std::string before_, after_;
  bool begun_ = false;
};

/// The commands of the scenario's first target.
RigCommands rig_commands_of(const scenario::Scenario& scenario);

}  // namespace canhil::drive
