// Writes and checks the protection of messages of other makers, with settings that are known only at run time
// (settings.hpp). The protection of canhil's own messages is fixed at build time: dbc/wire/e2e.hpp.
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

/// The protection of one message. An object never changes. Only make() allocates memory or returns errors.
class Protection {
 public:
  /// Makes the protection of the message `subject` with these settings. Returns the errors of validate().
  static Result<Protection> make(Settings settings, const Subject& subject);

  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] const Subject& subject() const { return subject_; }

  /// Writes the constants, the counter and the checksum into a packed message of the subject's size.
  /// `counter` may be a value that is not allowed, so that faults can be injected; only its low bits that fit
  /// the place are written. If the message has no counter, `counter` is ignored.
  void protect(std::span<std::uint8_t> data, std::uint64_t counter) const;

  /// Inverts all bits of the checksum, for fault injection. Does nothing if the message has no checksum.
  void spoil_checksum(std::span<std::uint8_t> data) const;

  /// True if the size, the constants and the checksum of a message are right. `data` may have any length.
  [[nodiscard]] bool checksum_right(std::span<const std::uint8_t> data) const;

  [[nodiscard]] bool has_counter() const { return settings_.counter.has_value(); }
  /// The counter in a message of the subject's size; 0: the message has no counter.
  [[nodiscard]] std::uint64_t counter(std::span<const std::uint8_t> data) const;
  /// The number of different values of the counter; 1: the message has no counter.
  [[nodiscard]] std::uint64_t period() const;
  [[nodiscard]] bool allowed(std::uint64_t counter) const;
  /// The first counter value that is sent.
  [[nodiscard]] std::uint64_t first() const;
  /// The counter value that is sent after `counter`, which must be allowed.
  [[nodiscard]] std::uint64_t next(std::uint64_t counter) const;
  /// The number of steps from one allowed counter value to another: 0..period() - 1.
  [[nodiscard]] std::uint64_t steps(std::uint64_t from, std::uint64_t to) const;
  /// True if the counters of both messages run through the same sequence of values, or if neither message has
  /// a counter. Messages that share a counter must meet this condition.
  [[nodiscard]] bool counts_like(const Protection& other) const;

 private:
  Protection(Settings settings, const Subject& subject);
  [[nodiscard]] std::uint64_t checksum(std::span<const std::uint8_t> data, std::uint64_t counter) const;

  Settings settings_;
  Subject subject_;
  std::uint64_t modulo_ = 1;
  std::vector<unsigned> covered_;  ///< indices of the bytes that the checksum covers, in order
  std::array<std::uint8_t, Frame::max_size> own_bits_{};  ///< mask of the checksum's bits
};

/// Stores the next counter value for one sent message, or for several messages that share a counter.
class Sender {
 public:
  void protect(const Protection& protection, std::span<std::uint8_t> data);
  void reset() { next_.reset(); }

 private:
  std::optional<std::uint64_t> next_;
};

/// The result of the check of a received message. The result also depends on the counter value that the
/// receiver stored last.
enum class Check : std::uint8_t {
  ok,                   ///< checksum right, counter as expected
  some_lost,            ///< checksum right, but the counter jumped: messages were lost
  repeated,             ///< checksum right, but the counter is that of the previous message: not new
  counter_not_allowed,  ///< checksum right, but the counter has a value that is never sent: discard
  wrong_checksum        ///< checksum, constant field or size wrong: discard
};

/// Stores the last counter value of one received message, or of several messages that share a counter.
class Receiver {
 public:
  /// Checks a message of any length. If the checksum is right and the counter is allowed, stores the counter.
  /// If the message has no counter, the result is ok or wrong_checksum.
  Check check(const Protection& protection, std::span<const std::uint8_t> data);
  /// The number of messages that were lost before the message that was checked last: 0..period() - 2.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  void reset() { last_.reset(); }

 private:
  std::optional<std::uint64_t> last_;
  std::uint64_t lost_ = 0;
};

}  // namespace canhil::protection
