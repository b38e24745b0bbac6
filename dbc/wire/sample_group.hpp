// A sample group: the messages that together carry one sample of a sensor or one answer of the target.
#pragma once

#include <cstdint>
#include <tuple>

#include "dbc/wire/message.hpp"

namespace canhil {

/// Collects the messages of one group, which all have the same E2E counter. Only complete groups are used.
template <class... Messages>
class SampleGroup {
 public:
  /// The result of put().
  enum class Outcome : std::uint8_t {
    waiting,          ///< the message is stored; the group is still incomplete
    complete,         ///< the message is stored; the group is complete and must be read now
    dropped_previous  ///< the message is stored; the previous, incomplete group was discarded
  };

  /// Stores a message with the counter `counter`. If `counter` differs from that of the pending group, a new
  /// group starts.
  template <class Message>
  Outcome put(const Message& message, std::uint8_t counter) {
    constexpr unsigned bit = bit_of<Message>();
    const bool started_anew = seen_ != 0 && counter != counter_;
    if (started_anew) seen_ = 0;
    counter_ = counter;
    std::get<Message>(messages_) = message;
    seen_ |= bit;
    if (seen_ == all) {
      seen_ = 0;
      return Outcome::complete;
    }
    return started_anew ? Outcome::dropped_previous : Outcome::waiting;
  }

  /// The last message of this type. If the last put() returned Outcome::complete, the messages of all types
  /// belong together.
  template <class Message>
  [[nodiscard]] const Message& get() const {
    return std::get<Message>(messages_);
  }
  /// The counter of the pending group or, if none is pending, of the last group.
  [[nodiscard]] std::uint8_t counter() const { return counter_; }
  /// Discards the pending group; false: no group was pending.
  bool discard() {
    const bool had = seen_ != 0;
    seen_ = 0;
    return had;
  }

 private:
  template <class Message>
  static constexpr unsigned bit_of() {
    unsigned index = 0;
    unsigned found = 0;
    (((std::is_same_v<Message, Messages>) ? (found = 1U << index) : 0U, ++index), ...);
    return found;
  }
  static constexpr unsigned all = (1U << sizeof...(Messages)) - 1U;

  std::tuple<Messages...> messages_{};
  unsigned seen_ = 0;
  std::uint8_t counter_ = 0;
};

}  // namespace canhil
