// The sender's part of the protocol. Every message has its own E2E counter, which is incremented with each
// transmission of the message. The messages of a sample group are sent equally often, so they have the same
// counter.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"

namespace canhil {

/// The index of a message in messages::all_messages.
template <class Message>
consteval std::size_t message_index() {
  for (std::size_t i = 0; i < messages::all_messages.size(); ++i) {
    if (messages::all_messages[i].id == Message::info.id &&
        messages::all_messages[i].extended == Message::info.extended) {
      return i;
    }
  }
  throw "message is not in the DBC";
}

/// The E2E counters of all messages that one node sends.
class TransmitCounters {
 public:
  /// Returns the counter (0..14) for this transmission of a message, and increments the counter of the
  /// message.
  template <class Message>
  std::uint8_t take() {
    std::uint8_t& next = next_[message_index<Message>()];
    const std::uint8_t now = next;
    next = e2e::next(now);
    return now;
  }
  /// Sets the counter of a message to 0.
  template <class Message>
  void restart() {
    next_[message_index<Message>()] = 0;
  }
  /// Sets all counters to 0.
  void reset() { next_.fill(0); }

 private:
  std::array<std::uint8_t, messages::all_messages.size()> next_{};
};

/// A buffer of fixed size for outgoing frames, with the E2E counters of the sender. Never allocates memory.
template <std::size_t capacity>
class Outbox {
 public:
  /// Makes an empty buffer; all counters are 0.
  explicit Outbox(Rounding rounding = Rounding::as_on_the_bus) : rounding_(rounding) {}

  /// Packs, protects and appends one message.
  template <class Message>
  void send(const Message& message) {
    if (size_ < capacity) frames_[size_++] = to_frame(message, counters_.take<Message>(), rounding_);
  }
  /// Appends a frame of another contract without changing it.
  void put(const Frame& frame) {
    if (size_ < capacity) frames_[size_++] = frame;
  }
  /// The frames since the last clear(), in order.
  [[nodiscard]] std::span<const Frame> frames() const { return {frames_.data(), size_}; }
  /// How scaled signals are rounded when they are packed.
  [[nodiscard]] Rounding rounding() const { return rounding_; }
  /// Empties the buffer; the counters keep their values.
  void clear() { size_ = 0; }
  /// Sets the counter of a message to 0.
  template <class Message>
  void restart() {
    counters_.restart<Message>();
  }
  /// Sets all counters to 0.
  void reset_counters() { counters_.reset(); }

 private:
  std::array<Frame, capacity> frames_{};
  std::size_t size_ = 0;
  TransmitCounters counters_;
  Rounding rounding_;
};

}  // namespace canhil
