// An emulated node: the time and the frames of its next transmission.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "dbc/wire/transmit.hpp"

namespace canhil::nodes {

/// The frames of one transmission: at most one sample group.
using Transmission = Outbox<8>;

inline constexpr std::int64_t never_us = std::numeric_limits<std::int64_t>::max();

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
  /// A frame from another node, valid or not.
  virtual void hear(const Frame& /*frame*/) {}
};

}  // namespace canhil::nodes
