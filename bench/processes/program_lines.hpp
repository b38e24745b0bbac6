// The lines that the bench and a program of the user exchange, and their deadlines.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "bench/processes/dialogue.hpp"
#include "bench/processes/program_settings.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::processes {

/// A program that runs. The destructor tells it to end, and kills it if it does not. All errors are one
/// phrase about what the program did.
class ProgramLines {
 public:
  using Time = Dialogue::Time;

  /// Starts a program of the user. Error, one phrase: the reason of the kernel.
  static Result<std::unique_ptr<ProgramLines>> start(const ProgramSettings& settings);
  explicit ProgramLines(Dialogue dialogue) : dialogue_(std::move(dialogue)) {}
  ProgramLines(const ProgramLines&) = delete;
  ProgramLines& operator=(const ProgramLines&) = delete;
  ~ProgramLines();

  /// Sends text; a program that has closed its standard input is reported by the next line that is read.
  Result<void> send(std::string_view text, std::chrono::microseconds patience);
  /// Sends text as far as the program takes it now; the rest is sent by flush().
  void post(std::string_view text);
  /// Whether nothing is left to be sent, now that the program may take more.
  bool flush();
  /// The next line of the program. Error: none comes in time, it is too long, or the program reports an
  /// error.
  Result<std::string> next(Time deadline, std::chrono::microseconds patience);
  /// Whether next() would not wait.
  bool has_next();
  /// Waits until next() would not wait; false: the deadline has passed.
  bool wait_next(Time deadline);
  void kill();
  /// Whether the program has closed its side.
  [[nodiscard]] bool is_closed() const { return closed_; }

 private:
  tl::unexpected<Error> late(std::chrono::microseconds patience) const;
  /// Why no further line comes from a program that has closed its standard output.
  tl::unexpected<Error> closed();
  [[nodiscard]] std::string after_last_line() const;

  Dialogue dialogue_;
  std::string unsent_{};
  std::string received_{};   // after the last line that was read
  std::string last_line_{};  // for messages
  bool closed_ = false, over_ = false;
};

}  // namespace canhil::processes
