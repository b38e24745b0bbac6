// Writes and checks the protection of other makers' messages, configured at run time (settings.hpp). The
// protection of canhil's own messages is fixed at build time: dbc/wire/e2e.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dbc/protection/settings.hpp"
#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::protection {

/// Protection of one message. Immutable; only make() allocates or fails.
class Protection {
 public:
  /// Protection of a message with these settings. Error: as validate().
  static Result<Protection> make(Settings settings, const Subject& subject);

  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] const Subject& subject() const { return subject_; }

  /// Writes constants, counter and checksum into a packed message of the subject's size. Accepts a counter
  /// that is not allowed, so that faults can be injected, and writes only as many of its low bits as fit its
  /// place. Ignores `counter` if the message has none.
  void protect(std::span<std::uint8_t> data, std::uint64_t counter) const;

  /// True if size, constants and checksum are right. The data may have any length.
  [[nodiscard]] bool checksum_right(std::span<const std::uint8_t> data) const;

  [[nodiscard]] bool has_counter() const { return settings_.counter.has_value(); }
  /// The counter in a message of the subject's size; 0 where the message has none.
  [[nodiscard]] std::uint64_t counter(std::span<const std::uint8_t> data) const;
  /// The number of values before the counter repeats; 1 where the message has none.
  [[nodiscard]] std::uint64_t period() const;
  [[nodiscard]] bool allowed(std::uint64_t counter) const;
  /// The first value that is sent.
  [[nodiscard]] std::uint64_t first() const;
  /// The value after an allowed one.
  [[nodiscard]] std::uint64_t next(std::uint64_t counter) const;
  /// The number of steps from one allowed value to another: 0..period() - 1.
  [[nodiscard]] std::uint64_t steps(std::uint64_t from, std::uint64_t to) const;
  /// True if both counters take the same values, which is necessary for messages that share a counter.
  [[nodiscard]] bool counts_like(const Protection& other) const;

 private:
  Protection(Settings settings, const Subject& subject);
  [[nodiscard]] std::uint64_t checksum(std::span<const std::uint8_t> data, std::uint64_t counter) const;

  Settings settings_;
  Subject subject_;
  std::uint64_t modulo_ = 1;
  std::vector<unsigned> covered_;                         ///< bytes of the message, in the checksum's order
  std::array<std::uint8_t, Frame::max_size> own_bits_{};  ///< mask of the checksum's bits
};

/// Holds the next counter of one sent message, or of several that share a counter.
class Sender {
 public:
  void protect(const Protection& protection, std::span<std::uint8_t> data);
  void reset() { next_.reset(); }

 private:
  std::optional<std::uint64_t> next_;
};

/// The result of checking a received message, given the messages before it.
enum class Check : std::uint8_t {
  ok,                   ///< checksum right, counter follows
  some_lost,            ///< checksum right, counter jumped: messages were lost in between
  repeated,             ///< checksum right, same counter as before: not new
  counter_not_allowed,  ///< checksum right, but the counter has a value that is never sent: discard
  wrong_checksum        ///< checksum, constant field or size wrong: discard
};

/// Holds the last counter of one received message, or of several that share a counter.
class Receiver {
 public:
  /// Checks a message of any length and stores its counter if that is allowed. Without a counter the result
  /// is ok or wrong_checksum.
  Check check(const Protection& protection, std::span<const std::uint8_t> data);
  /// The number of messages lost before the last one checked: 0..period() - 2.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  void reset() { last_.reset(); }

 private:
  std::optional<std::uint64_t> last_;
  std::uint64_t lost_ = 0;
};

}  // namespace canhil::protection
