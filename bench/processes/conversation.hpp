// The bench's side of the conversation with a program of the user: the process, its lines and their
// deadlines.
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/processes/program_lines.hpp"
#include "bench/processes/program_protocol.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::processes {

/// A program that answers each step with the values of its outputs. All errors are one phrase with the
/// command, the time of the run and the reason; after an error the program has been killed.
class Conversation {
 public:
  /// Starts the program and reads what it declares, and its outputs at time 0. `settings` must outlive the
  /// conversation. Error: it cannot be started, or does not answer as the protocol says.
  static Result<std::unique_ptr<Conversation>> start(const ProgramSettings& settings,
                                                     const program_protocol::Opening& opening);

  [[nodiscard]] const program_protocol::Declared& declared() const { return declared_; }
  /// The values of the declared outputs at the time that the program has reached.
  [[nodiscard]] std::span<const double> outputs() const { return outputs_; }
  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs);
  /// The first half of step(): asks, and does not wait for the answer. Errors are those of answer().
  void ask(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs);
  /// The second half: reads the answer to ask().
  Result<void> answer();

 private:
  Conversation(const ProgramSettings& settings, std::unique_ptr<ProgramLines> lines)
      : settings_(settings), lines_(std::move(lines)) {}
  Result<void> open(const program_protocol::Opening& opening);
  Result<void> asked(std::span<const double> inputs);
  Result<void> answered();
  Result<void> expect_silence();

  const ProgramSettings& settings_;
  std::unique_ptr<ProgramLines> lines_;
  program_protocol::Declared declared_{};
  std::vector<double> outputs_{};
  std::int64_t from_us_ = 0, to_us_ = 0;  // of the step that was asked for
  Result<void> asked_{};
  ProgramLines::Time deadline_{};  // of its answer
};

}  // namespace canhil::processes
