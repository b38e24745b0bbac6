// The shell commands of a scenario around its flight: power, reset, relays.
#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::scenario {
struct Scenario;
}

namespace canhil::drive {

/// Runs the command `after` of a target whenever its command `before` was begun, however the run ends. An
/// empty command does nothing. Several targets: their commands are run in the order of the scenario.
class RigCommands {
 public:
  struct Commands {
    std::string before, after;
  };
  explicit RigCommands(std::vector<Commands> of_targets) : of_targets_(std::move(of_targets)) {}
  RigCommands(const RigCommands&) = delete;
  RigCommands& operator=(const RigCommands&) = delete;
  ~RigCommands() { finish(); }

  /// Runs each `before` to its end; if `stop` becomes true, ends the command and the processes that it
  /// started. Error: it did not exit with 0, or it was interrupted.
  Result<void> begin(const std::atomic<bool>& stop);
  /// Runs each `after` to its end, also if the run was interrupted, unless its `before` was not begun or it
  /// has run already. If it does not exit with 0, prints a line.
  void finish();

 private:
  std::vector<Commands> of_targets_;
  std::size_t begun_ = 0;  // number of targets whose command `before` was begun
};

/// The commands of the scenario's targets.
RigCommands rig_commands_of(const scenario::Scenario& scenario);

}  // namespace canhil::drive
