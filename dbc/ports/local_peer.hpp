// A node of the embedded bus as the hub sees it: one connection.
#pragma once

#include <cstddef>
#include <string>

#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/local_place.hpp"
#include "dbc/ports/local_wire.hpp"

namespace canhil::local {

struct Peer {
  Descriptor socket;
  Process process;
  std::int64_t came_ns = 0;  ///< CLOCK_MONOTONIC
  std::string name;
  bool joined = false;  ///< has said Hello
  bool own_echo = false;
  bool only_some = false;
  bool mute = false;    ///< takes no more frames; what it sent before still counts
  bool behind = false;  ///< the hub's pending frame is still to be delivered
  bool held = false;    ///< its queue on the simulated wire is full: not read
  std::size_t wire_node = 0;
  IdSet wanted;
  std::int64_t behind_since_ns = 0;  ///< CLOCK_MONOTONIC, where it is behind
  /// How long the bus stood still for it, less what it has worked off since by taking frames.
  std::int64_t arrears_ns = 0;
};

/// What a node works off with each frame that it takes: a node that never reads and one that reads so slowly
/// that it drags the bus along are one case. The time of a full frame at 500 kbit/s, which every node keeps
/// up with on a wire.
constexpr std::int64_t worked_off_ns = 250'000;

/// Who it is, for a person: "node 'hil-target' (pid 17 of uid 1000)".
std::string to_text(const Peer& peer);

/// What came of reading from a node.
enum class Reading : std::uint8_t { nothing, joined, frame, nonsense, gone };

/// Reads what the node says next: Hello, or a frame into `datagram` and `frame`; `nonsense`: neither.
Reading read(Peer& peer, bool fd_bus, Datagram& datagram, Frame& frame);

/// Gives a frame to the node if it wants it; `own`: it is the node's own. False: the node wants it and has no
/// room for it.
bool offer(Peer& peer, Datagram& datagram, bool own);

}  // namespace canhil::local
