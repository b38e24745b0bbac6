// A program that the bench starts, together with the processes that this program starts.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::processes {

/// How a process ended.
struct ProcessEnd {
  int signal = 0;       ///< the signal that ended it; 0: it exited
  int status = 0;       ///< its exit status, if it exited
  bool killed = false;  ///< ChildProcess::end() had to kill it, because it did not end on SIGTERM
  [[nodiscard]] bool exited_with_0() const { return signal == 0 && status == 0; }
};
/// "ended by SIGSEGV (Segmentation fault)", "exited with 3".
std::string to_text(const ProcessEnd& end);

/// How a program is started, in addition to its command line.
struct StartOptions {
  std::vector<int> cpus{};  ///< CPUs on which it runs; empty: those of the bench
  std::string folder{};     ///< its working folder; empty: that of the bench
  int input = -1;           ///< descriptor that becomes its standard input; -1: that of the bench
  int output = -1;          ///< descriptor that becomes its standard output; -1: the bench's standard
                            ///< error, because the bench may write a report to its standard output
  /// Whether it runs without real-time priority, and then on any CPU, if the bench has a real-time priority.
  bool ordinary = false;
  int signal_at_death = SIGTERM;  ///< sent by the kernel if the thread that started the program ends
};

/// A child process in a session and a process group of its own. So signals that the terminal, or a program
/// such as `timeout`, sends to the bench's group do not reach it, and end() also ends the processes that it
/// started. The destructor ends it; if the bench dies, the kernel ends it.
class ChildProcess {
 public:
  /// Starts a program with the command line `words`; a relative path of the program is relative to its
  /// working folder. Error: the reason of the kernel, such as "Permission denied".
  static Result<ChildProcess> start(const std::string& program, std::vector<std::string> words,
                                    const StartOptions& options = {});

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

}  // namespace canhil::processes
