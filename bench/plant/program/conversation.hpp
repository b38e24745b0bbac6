// The bench's side of the conversation with a plant's program: the process, its lines and their deadlines.
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/plant/plant.hpp"
#include "bench/plant/program/protocol.hpp"
#include "bench/processes/dialogue.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::plant {

/// How a program is started, and how long the bench waits for it.
struct ProgramSettings {
  std::string command{};  ///< as the scenario gives it
  std::vector<std::string> words{};
  std::string folder{};  ///< working folder; empty: that of the bench
  std::vector<program_protocol::Parameter> parameters{};
  std::chrono::microseconds starts_within{}, answers_within{};
};

/// A program that runs. The destructor tells it to end, and kills it if it does not. All errors are one
/// phrase with the command, the time of the run and the reason; after an error the program has been killed.
class Conversation {
 public:
  /// Starts the program and reads what it declares, and its outputs at time 0. `settings` must outlive the
  /// conversation. Error: it cannot be started,
  /// or does not answer as the protocol says.
  static Result<std::unique_ptr<Conversation>> start(const ProgramSettings& settings, const Draw& draw);

  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;
  ~Conversation();

  [[nodiscard]] const program_protocol::Declared& declared() const { return declared_; }
  /// The values of the declared outputs at the time that the program has reached.
  [[nodiscard]] std::span<const double> outputs() const { return outputs_; }
  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs);

 private:
  using Time = processes::Dialogue::Time;

  Conversation(const ProgramSettings& settings, processes::Dialogue dialogue)
      : settings_(settings), dialogue_(std::move(dialogue)) {}
  Result<void> open(const Draw& draw);
  Result<void> exchange(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs);
  /// Sends text; a program that has closed its standard input is reported by the next line that is read.
  Result<void> send(std::string_view text, std::chrono::microseconds patience);
  /// The next line of the program. Error: none comes in time, it is too long, or the program reports an
  /// error.
  Result<std::string> next_line(Time deadline, std::chrono::microseconds patience);
  Result<void> expect_silence();
  tl::unexpected<Error> late(std::chrono::microseconds patience) const;
  /// Why no further line comes from a program that has closed its standard output.
  tl::unexpected<Error> closed();
  [[nodiscard]] std::string after_last_line() const;
  void kill();

  const ProgramSettings& settings_;
  processes::Dialogue dialogue_;
  std::string received_{};   // after the last line that was read
  std::string last_line_{};  // for messages
  program_protocol::Declared declared_{};
  std::vector<double> outputs_{};
  bool over_ = false;
};

}  // namespace canhil::plant
