// Writes and checks the protection of other makers' messages, as settings.hpp describes it at run time. That
// of canhil's own messages, fixed at build time, is dbc/wire/e2e.hpp.
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

/// Protection of one message. Immutable; no member allocates or fails but make().
class Protection {
 public:
  /// Takes settings for a message, or gives the error of validate().
  static Result<Protection> make(Settings settings, const Subject& subject);

  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] const Subject& subject() const { return subject_; }

  /// Writes constants, counter and checksum into a packed message of the subject's size. A counter's value
  /// that is not allowed is sent all the same, so that faults can be played; bits beyond its place are cut
  /// off. Ignored where the message has no counter.
  void protect(std::span<std::uint8_t> data, std::uint64_t counter) const;

  /// True if size, constants and checksum are right. The data may have any length.
  [[nodiscard]] bool checksum_right(std::span<const std::uint8_t> data) const;

  [[nodiscard]] bool has_counter() const { return settings_.counter.has_value(); }
  /// The counter in a message of the subject's size; 0 where the message has none.
  [[nodiscard]] std::uint64_t counter(std::span<const std::uint8_t> data) const;
  /// Values that the counter takes until it starts over; 1 where the message has none.
  [[nodiscard]] std::uint64_t period() const;
  [[nodiscard]] bool allowed(std::uint64_t counter) const;
  /// The first value that is sent.
  [[nodiscard]] std::uint64_t first() const;
  /// The value after an allowed one.
  [[nodiscard]] std::uint64_t next(std::uint64_t counter) const;
  /// Steps from one allowed value up to another: 0..period() - 1.
  [[nodiscard]] std::uint64_t steps(std::uint64_t from, std::uint64_t to) const;
  /// True if both count the same values, as messages that share a counter must.
  [[nodiscard]] bool counts_like(const Protection& other) const;

 private:
  Protection(Settings settings, const Subject& subject);
  [[nodiscard]] std::uint64_t checksum(std::span<const std::uint8_t> data, std::uint64_t counter) const;

  Settings settings_;
  Subject subject_;
  std::uint64_t modulo_ = 1;
  std::vector<unsigned> covered_;                         ///< bytes of the message, in the checksum's order
  std::array<std::uint8_t, Frame::max_size> own_bits_{};  ///< of the checksum, byte by byte
};

/// Sender of one message, or of several that share a counter: holds the next counter.
class Sender {
 public:
  void protect(const Protection& protection, std::span<std::uint8_t> data);
  void reset() { next_.reset(); }

 private:
  std::optional<std::uint64_t> next_;
};

/// What a received message's protection says, given those before it.
enum class Check : std::uint8_t {
  ok,                   ///< checksum right, counter follows
  some_lost,            ///< checksum right, counter jumped: messages are missing in between
  repeated,             ///< checksum right, same counter as before: not new
  counter_not_allowed,  ///< checksum right, but such a counter is never sent: to be dropped
  wrong_checksum        ///< checksum, constant field or size wrong: to be dropped
};

/// Receiver of one message, or of several that share a counter: holds the last counter.
class Receiver {
 public:
  /// Checks a message, whatever its length, and takes over a counter that is allowed. Without a counter:
  /// ok or wrong_checksum.
  Check check(const Protection& protection, std::span<const std::uint8_t> data);
  /// Messages missing before the last one checked: 0..period() - 2.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  void reset() { last_.reset(); }

 private:
  std::optional<std::uint64_t> last_;
  std::uint64_t lost_ = 0;
};

}  // namespace canhil::protection
