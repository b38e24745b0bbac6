// A program that the bench exchanges bytes with, over the program's standard input and output or over a
// connection.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/processes/child_process.hpp"
#include "dbc/ports/descriptor.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::processes {

/// A child process whose standard input and output are pipes to the bench, or a connection. No call waits
/// longer than its deadline. What the program writes to its standard error goes to that of the bench.
class Dialogue {
 public:
  using Time = std::chrono::steady_clock::time_point;
  enum class Outcome {
    done,
    closed,  ///< the program has closed the stream; usually it has ended
    late     ///< the deadline has passed
  };

  /// Starts a program (ChildProcess::start()); `options` must not name streams. SIGPIPE is ignored from then
  /// on, because a write to a program that has ended must not end the bench.
  static Result<Dialogue> start(const std::string& program, std::vector<std::string> words,
                                StartOptions options = {});

  /// A connection to a program that the bench did not start. Error: the reason of the kernel.
  static Result<Dialogue> over(Descriptor connection);

  /// Sends all bytes.
  Outcome send(std::string_view bytes, Time deadline) { return send_some(bytes, deadline); }
  /// Sends bytes, and leaves in `bytes` those that were not sent before the deadline.
  Outcome send_some(std::string_view& bytes, Time deadline);
  /// Waits for bytes of the program and appends them to `received`, at most `most` of them.
  Outcome receive(std::string& received, Time deadline, std::size_t most = 4096);
  /// The program reads the end of its standard input.
  void close_input() { to_program_ = Descriptor(); }

  /// Null: the bench did not start the program.
  [[nodiscard]] ChildProcess* process() { return process_ ? &*process_ : nullptr; }

 private:
  Dialogue(std::optional<ChildProcess> process, Descriptor to_program, Descriptor from_program)
      : process_(std::move(process)),
        to_program_(std::move(to_program)),
        from_program_(std::move(from_program)) {}

  std::optional<ChildProcess> process_;
  // Closed before the process is ended, so that it can end by itself.
  Descriptor to_program_, from_program_;
};

}  // namespace canhil::processes
