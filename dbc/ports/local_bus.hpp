// The embedded bus `local:NAME`: CAN between processes of one machine, where the kernel has no AF_CAN.
//
// The host's port is the hub. Each node has one Unix SOCK_SEQPACKET connection to it, so a frame takes one
// hop between host and node, two between nodes. The hub decides the bus order and stamps each frame
// (CLOCK_MONOTONIC). Nothing is ever lost: a frame that send() took reaches every node, in the same order at
// each. Where one node has no room the bus stands still until it reads or dies, which senders see as
// queue_full. So every node must read.
//
// `local:NAME?bitrate=500000` gives the bus a wire (simulated_wire.hpp) that runs in real time: a frame takes
// as long as its bits, the lowest id wins, every node has a queue of 64 frames, in the order of sending or,
// with `&queue=priority`, of priority; `&data-bitrate=2000000` is for CAN FD. The stamp is the end of the
// frame on that wire, to the nanosecond, however late the hub's process gets to run.
// `&bit-error-rate=1e-6&seed=3` disturbs it: a node then receives the error frames of its own controller, and
// what waits in its queue is lost when that goes off the bus. Only the host needs to say so.
#pragma once

#include <functional>

#include "dbc/ports/port.hpp"

namespace canhil {

class LocalHub : public Port {
 public:
  /// The names of the nodes that have joined.
  [[nodiscard]] virtual std::vector<std::string> nodes() const = 0;
  /// The node for whose sake the bus stands still; empty: none.
  [[nodiscard]] virtual std::string held_up_by() const = 0;
};

/// Founds the bus `local:NAME`; options.fd decides for all whether it carries CAN FD. The hub works only
/// within send() and receive(): call receive() whenever descriptor() is readable. Error: a wrong name, or a
/// bus hosted already.
Result<std::unique_ptr<LocalHub>> host_local_bus(std::string_view bus, const PortOptions& options);

/// Joins the bus `local:NAME`. Error: a wrong name, nobody hosts it, or it has the other frame format.
Result<std::unique_ptr<Port>> join_local_bus(std::string_view bus, const PortOptions& options);

/// Serves a bus that has a hub and no host of its own (`hil-bench bus local:NAME`), until stop(); asks it at
/// least every 100 ms.
void run_hub(Port& hub, const std::function<bool()>& stop);

}  // namespace canhil
