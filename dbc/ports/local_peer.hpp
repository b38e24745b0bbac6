// A node of the embedded bus as the hub sees it: one connection.
#pragma once

#include <cstddef>
#include <string>

#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/local_wire.hpp"

namespace canhil::local {

struct Peer {
  Descriptor socket;
  std::string name;
  bool joined = false;  ///< has said Hello
  bool own_echo = false;
  bool only_some = false;
  bool mute = false;    ///< takes no more frames; what it sent before still counts
  bool behind = false;  ///< the hub's pending frame is still to be delivered
  bool held = false;    ///< its queue on the simulated wire is full: not read
  std::size_t wire_node = 0;
  IdSet wanted;
};

/// What came of reading from a node.
enum class Reading : std::uint8_t { nothing, joined, frame, gone };

/// Reads what the node says next: Hello, or a frame into `datagram` and `frame`.
Reading read(Peer& peer, bool fd_bus, Datagram& datagram, Frame& frame);

/// Gives a frame to the node if it wants it; `own`: it is the node's own. False: the node wants it and has no
/// room for it.
bool offer(Peer& peer, Datagram& datagram, bool own);

}  // namespace canhil::local
