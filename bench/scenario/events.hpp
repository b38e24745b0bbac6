// Reads [[event]]: what the bench says to a target beside its samples, once and at a certain moment: a
// request of diagnostics, a command, a state of the network. The binding defines the channels on which it
// says it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/expression.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::scenario {

class Section;
struct Binding;

/// Bytes of an answer as a scenario expects them: "62 F1 90 .. *". `..` is any byte; `*` at the end any
/// number of further bytes.
class BytePattern {
 public:
  /// Error: what is wrong, one phrase.
  static Result<BytePattern> parse(std::string_view text);

  [[nodiscard]] bool matches(std::span<const std::uint8_t> bytes) const;
  [[nodiscard]] std::string to_text() const;
  /// The bytes themselves, if each of them is given; none: some are not.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> exact() const;

 private:
  std::vector<std::optional<std::uint8_t>> bytes_;
  bool open_ = false;  // ends with *
};

/// "62 F1 90"; long ones are cut.
std::string to_text(std::span<const std::uint8_t> bytes);

struct Event {
  /// What the event waits for.
  enum class When : std::uint8_t {
    start,    ///< before the run, when the target's programs are there
    end,      ///< after the run
    time,     ///< `at_us`
    truth,    ///< the first time that `condition` is not 0
    flag,     ///< the first answer in which `flag` is `flag_set`
    answered  ///< the answer to the event `after`
  };

  std::string name;         ///< unique in the scenario
  std::string requirement;  ///< id for the reports; may be empty
  When when = When::time;
  std::int64_t at_us = 0;
  std::optional<Expression> condition{};
  std::string flag{};
  bool flag_set = true;
  std::size_t after = 0;      ///< index of an earlier event
  std::int64_t delay_us = 0;  ///< from the moment that it waits for
  std::size_t channel = 0;    ///< index in Binding::channels
  std::vector<std::uint8_t> request{};
  std::int64_t times = 1, period_us = 0;    ///< how often it is sent, and how far apart
  std::optional<BytePattern> expected{};    ///< of each answer; none: no answer is judged
  std::optional<std::int64_t> within_us{};  ///< limit of the time to the answer

  /// The time for which the bench waits for an answer.
  [[nodiscard]] std::int64_t patience_us() const {
    return within_us ? *within_us + usual_patience_us : usual_patience_us;
  }
  static constexpr std::int64_t usual_patience_us = 1'000'000;
};

/// The part of a run to which an event belongs.
enum class Phase : std::uint8_t { before, during, after };
/// The phase of one of these events: that of the moment with which its chain of answers begins.
Phase phase_of(std::span<const Event> events, const Event& event);

/// Reads all events of a file.
std::vector<Event> read_events(Section& root, const Binding& binding, std::int64_t duration_us);

}  // namespace canhil::scenario
