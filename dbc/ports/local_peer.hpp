// A node of the embedded bus as the hub knows it: one connection.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "dbc/ports/datagram_batch.hpp"
#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/local_place.hpp"
#include "dbc/ports/local_wire.hpp"

namespace canhil::local {

struct Peer {
  Descriptor socket;
  Process process;
  std::int64_t came_ns = 0;  ///< when the node connected, on CLOCK_MONOTONIC
  std::string name;
  bool joined = false;  ///< the node has sent its Hello
  bool own_echo = false;
  bool together = false;  ///< the node takes several frames in one message
  bool only_some = false;
  bool mute = false;    ///< the node accepts no more frames; frames that it sent before are still used
  bool behind = false;  ///< the node had no room for the hub's pending frame, and so stalls the bus
  bool held =
      false;  ///< the hub does not read from the node, because its queue on the simulated wire is full
  std::size_t wire_node = 0;
  IdSet wanted;
  std::int64_t behind_since_ns = 0;  ///< if `behind`: since when, on CLOCK_MONOTONIC
  /// When a stall that the node causes ends, this value grows by the duration of the stall. It falls by
  /// worked_off_ns for each frame that the node receives, but not below 0.
  std::int64_t arrears_ns = 0;
};

/// Each frame that a node receives reduces its arrears by this time. So one rule covers nodes that never read
/// and nodes that read too slowly. The time is the duration of a full frame at 500 kbit/s, because on a real
/// wire every node must be able to receive frames at this rate.
constexpr std::int64_t worked_off_ns = 250'000;

/// Text for messages, such as "node 'hil-target' (pid 17 of uid 1000)".
std::string to_text(const Peer& peer);

/// The result of read(). gone: the node has closed the connection.
enum class Reading : std::uint8_t { nothing, joined, frame, nonsense, gone };

/// Reads the next datagram of a node. If it is a frame, stores it in `datagram` and `frame`; if it is a
/// Hello, stores its content in `peer`. The result is `nonsense` if the datagram is neither.
Reading read(Peer& peer, bool fd_bus, Datagram& datagram, Frame& frame);

/// Reads the datagrams of a node that has joined, many in one system call, and calls `each` with every frame.
/// The result is `frame` if all were frames; it is that of the last datagram otherwise.
Reading read_all(const Peer& peer, DatagramBatch& batch, bool fd_bus,
                 const std::function<void(const Frame&)>& each);

/// The names of the nodes that have joined.
std::vector<std::string> names(const std::vector<Peer>& peers);

/// The name of the first node that stalls the bus; empty: none does.
std::string first_behind(const std::vector<Peer>& peers);

/// Sends a frame to the node if the node wants the frame. `own` means that the node itself sent the frame.
/// False: the node wants the frame but has no room.
bool offer(Peer& peer, Datagram& datagram, bool own);

/// Whether the node wants every frame of the bus, so that offer_all() may be used.
bool gets_all(const Peer& peer);
/// Sends frames of other nodes with their stamp; see send_frames(). Returns how many the node took.
std::size_t offer_all(Peer& peer, std::span<const Frame> frames, bool fd_bus, std::int64_t t_ns);

}  // namespace canhil::local
