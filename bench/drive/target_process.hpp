// The targets as child processes of the bench.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/drive/ending.hpp"
#include "bench/process/child_process.hpp"

namespace canhil::drive {

using process::ChildProcess;
using process::ProcessEnd;

/// Starts `COMMAND --bus BUS`, followed by the arguments `more`, on the given CPUs (if `cpus` is empty: on
/// the bench's CPUs). target_words() splits the command into words. Error, one line: the program cannot be
/// started.
Result<ChildProcess> start_target(const std::string& command, const std::string& bus,
                                  const std::vector<std::string>& more = {},
                                  const std::vector<int>& cpus = {});

/// The programs that a run starts: in most runs one, with several mapped targets one for each.
class TargetPrograms {
 public:
  /// Starts the programs. Error, one line: one of them cannot be started.
  Result<void> start(const std::vector<std::string>& commands, const std::string& bus,
                     const std::vector<std::string>& more, const std::vector<int>& cpus);
  /// Kills all programs at once.
  void kill();
  [[nodiscard]] bool empty() const { return running_.empty(); }
  [[nodiscard]] std::vector<pid_t> ids() const;
  /// How a program ended, with the words for it: "target: exited with 3"; none: all run.
  std::optional<std::string> ended();
  /// Whether a program is stopped by a signal such as SIGSTOP.
  [[nodiscard]] bool stopped() const;
  void send_signal(int signal);

  struct End {
    ProcessEnd of;  ///< of the first program that did not end as it should; else of the first one
    bool any_killed = false;
  };
  /// Ends all programs: see ChildProcess::end().
  End end(std::chrono::milliseconds patience);

 private:
  std::vector<ChildProcess> running_;
  std::vector<std::string> commands_;
};

/// The ending of a run, given how the target's process ended. A target that the bench started must run until
/// the bench stops it, and must then end without an error (wrong_end()). `ended_before`: how it ended before
/// the bench stopped it; none: it did not.
Ending with_process_end(Ending ending, const std::optional<std::string>& ended_before, const ProcessEnd& end);

/// What is wrong with the end of a target that ran until the bench ended it with SIGTERM, or that the bench
/// told to stop before; empty: it ended as it should. By the convention of shells and of Java, a program may
/// also exit with 128 plus the number of the signal.
std::string wrong_end(const ProcessEnd& end);

}  // namespace canhil::drive
