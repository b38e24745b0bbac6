// A program that the bench starts, together with the processes that this program starts.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::process {

/// How a process ended.
struct ProcessEnd {
  int signal = 0;       ///< the signal that ended it; 0: it exited
  int status = 0;       ///< its exit status, if it exited
  bool killed = false;  ///< ChildProcess::end() had to kill it, because it did not end on SIGTERM
  [[nodiscard]] bool exited_with_0() const { return signal == 0 && status == 0; }
};
/// "ended by SIGSEGV (Segmentation fault)", "exited with 3".
std::string to_text(const ProcessEnd& end);

/// A child process in a session and a process group of its own. So signals that the terminal, or a program
/// such as `timeout`, sends to the bench's group do not reach it, and end() also ends the processes that it
/// started. The destructor ends it; if the bench dies, the kernel sends it SIGTERM.
class ChildProcess {
 public:
  /// Starts a program with the command line `words`, on the given CPUs (if `cpus` is empty: on the bench's
  /// CPUs). Its standard output is the bench's standard error, because the bench may write a report to its
  /// own standard output. `standard_input`: the descriptor of its standard input, if not the bench's. Error:
  /// the reason of the kernel, such as "Permission denied".
  static Result<ChildProcess> start(const std::string& program, std::vector<std::string> words,
                                    const std::vector<int>& cpus = {},
                                    std::optional<int> standard_input = {});

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  [[nodiscard]] pid_t id() const { return pid_; }
  /// How the process ended; none: it is running.
  std::optional<ProcessEnd> ended();
  /// True while the process is stopped by a signal such as SIGSTOP.
  [[nodiscard]] bool stopped() const;
  /// Sends a signal to all processes of the group.
  void send_signal(int signal);
  /// Ends all processes of the group: SIGTERM, and SIGKILL for those that still run after `patience`. Returns
  /// how the process ended.
  ProcessEnd end(std::chrono::milliseconds patience);
  /// After the process ended: lets the other processes of its group run on.
  void leave();
  static constexpr std::chrono::milliseconds usual_patience{2000};  ///< enough for reports of leaks, profiles
  static constexpr std::chrono::milliseconds short_patience{400};   ///< if nothing is judged any more

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}
  bool reap();

  pid_t pid_ = -1;  // -1: moved from
  bool reaped_ =
      false;  // neither the process nor another of its group is left, or this object was moved from
  std::optional<ProcessEnd> ended_;
};

}  // namespace canhil::process
