// The target as a child process of the bench.
#pragma once

#include <sys/types.h>
#include <optional>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::drive {

/// A started target. The destructor of this object terminates the target; if the bench dies, the kernel
/// terminates the target.
class TargetProcess {
 public:
  /// Starts `COMMAND --bus BUS`, followed by the arguments `more`, on the given CPUs (if `cpus` is empty: on
  /// the bench's CPUs). target_words() splits the command into words. Error: the program cannot be started.
  static Result<TargetProcess> start(const std::string& command, const std::string& bus,
                                     const std::vector<std::string>& more = {},
                                     const std::vector<int>& cpus = {});

  TargetProcess(TargetProcess&& other) noexcept;
  TargetProcess(const TargetProcess&) = delete;
  TargetProcess& operator=(const TargetProcess&) = delete;
  ~TargetProcess();

  /// How the process ended, as a phrase for people; none: the process is running.
  std::optional<std::string> ended();
  /// True while the process is stopped by a signal such as SIGSTOP.
  [[nodiscard]] bool stopped() const;
  /// Sends a signal if the process is still running.
  void send_signal(int signal);
  /// Kills the process immediately (SIGKILL).
  void kill_it();

 private:
  explicit TargetProcess(pid_t pid) : pid_(pid) {}
  pid_t pid_ = -1;
  std::optional<std::string> ended_;
};

}  // namespace canhil::drive
