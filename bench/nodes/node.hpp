// An emulated node: the time and the frames of its next transmission.
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "bench/nodes/clipped.hpp"
#include "bench/sensors/sample.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::nodes {

/// The frames of one transmission: at most one sample group. Remembers which values the signals clipped.
class Transmission : public Outbox<8> {
 public:
  static constexpr std::size_t most = 8;  ///< frames
  using Outbox<most>::Outbox;

  /// Packs, protects and appends one message. Values of a message that is marked as invalid may be clipped.
  template <class Message>
  void send(const Message& message) {
    bool valid = true;
    Message::visit(message, [&](const SignalInfo&, const auto& member) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, messages::Validity>)
        valid = valid && member != messages::Validity::invalid;
    });
    Message::visit(message, [&](const SignalInfo& signal, const auto& member) {
      if (valid) clipped_.check(Message::info, signal, static_cast<double>(member));
    });
    send_fitting(message);
  }
  /// Like send(), for a message whose values are known to fit into their signals.
  template <class Message>
  void send_fitting(const Message& message) {
    Outbox<most>::send(message);
  }
  /// The values that were clipped since the construction.
  [[nodiscard]] const Clipped& clipped() const { return clipped_; }
  Clipped& clipped() { return clipped_; }

 private:
  Clipped clipped_;
};

using sensors::never_us;

/// A node of the bus, emulated by the bench. All times are in the bench's time base [us].
class Node {
 public:
  Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  virtual ~Node() = default;

  /// Time of the next transmission; never_us after the last one.
  [[nodiscard]] virtual std::int64_t due_us() const = 0;
  /// Appends the frames of the due transmission and advances to the next.
  virtual void transmit(Transmission& out) = 0;

  /// Whether the node wants to receive frames of other nodes.
  [[nodiscard]] virtual bool listens() const { return false; }
  /// Whether it also wants to receive the frames that the bench sends.
  [[nodiscard]] virtual bool overhears() const { return false; }
  /// A frame from another node, valid or not. Returns whether due_us() may have changed.
  virtual bool hear(const Frame& /*frame*/, std::int64_t /*now_us*/) { return false; }

  /// Whether the node waits for an answer to its last frame. In virtual time, an answer takes no time.
  [[nodiscard]] virtual bool awaits() const { return false; }
  /// Waits no longer.
  virtual void give_up(std::int64_t /*now_us*/) {}
};

}  // namespace canhil::nodes
