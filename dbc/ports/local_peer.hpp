// A node of the embedded bus, from the hub's side: one connection.
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
  bool joined = false;  ///< has sent its Hello
  bool own_echo = false;
  bool only_some = false;
  bool mute = false;    ///< accepts no more frames; frames that it sent before still count
  bool behind = false;  ///< the hub's pending frame is still to be delivered
  bool held = false;    ///< its queue on the simulated wire is full: the hub does not read from it
  std::size_t wire_node = 0;
  IdSet wanted;
  std::int64_t behind_since_ns = 0;  ///< CLOCK_MONOTONIC, if it is behind
  /// How long the node has stalled the bus so far, minus worked_off_ns for each frame that it took
  /// afterwards.
  std::int64_t arrears_ns = 0;
};

/// Each frame that a node takes reduces its arrears by this time, so that one rule covers nodes that never
/// read and nodes that read too slowly. It is the duration of a full frame at 500 kbit/s: on a real wire
/// every node must keep up with that rate.
constexpr std::int64_t worked_off_ns = 250'000;

/// For messages: "node 'hil-target' (pid 17 of uid 1000)".
std::string to_text(const Peer& peer);

/// The outcome of reading from a node.
enum class Reading : std::uint8_t { nothing, joined, frame, nonsense, gone };

/// Reads the node's next datagram: a Hello, or a frame into `datagram` and `frame`; `nonsense`: neither.
Reading read(Peer& peer, bool fd_bus, Datagram& datagram, Frame& frame);

/// Sends a frame to the node if it wants it; `own`: the node itself sent it. False: the node wants the frame
/// but has no room.
bool offer(Peer& peer, Datagram& datagram, bool own);

}  // namespace canhil::local
