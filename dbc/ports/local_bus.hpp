// The embedded bus `local:NAME`: CAN between processes of one machine, where the kernel has no AF_CAN.
//
// The host's port is the hub. Each node has one Unix SOCK_SEQPACKET connection to it, so a frame takes one
// hop between host and node, two between nodes. The hub decides the bus order and stamps each frame
// (CLOCK_MONOTONIC). Nothing is ever lost: a frame that send() took reaches every node, in the same order at
// each. Where one node has no room the bus stands still until it reads or dies, which senders see as
// queue_full. So every node must read: one for whose sake the bus stands still for too long is dropped.
//
// A bus belongs to one user: its sockets are in a directory of mode 0700 (`canhil` in XDG_RUNTIME_DIR, or
// /tmp/canhil-uid-UID), and host and node each look at whose process the other one is (SO_PEERCRED).
//
// `local:NAME?bitrate=500000` gives the bus a wire (simulated_wire.hpp) that runs in real time: a frame takes
// as long as its bits, the lowest id wins, every node has a queue of 64 frames, in the order of sending or,
// with `&queue=priority`, of priority; `&data-bitrate=2000000` is for CAN FD. The stamp is the end of the
// frame on that wire, to the nanosecond, however late the hub's process gets to run.
// `&bit-error-rate=1e-6&seed=3` disturbs it: a node then receives the error frames of its own controller, and
// what waits in its queue is lost when that goes off the bus. Only the host needs to say so.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "dbc/ports/port.hpp"

namespace canhil {

/// What the name of every embedded bus begins with.
inline constexpr std::string_view local_prefix = "local:";
constexpr bool is_local(std::string_view bus) { return bus.starts_with(local_prefix); }
/// Gives `local:` and `local:?bitrate=500000`, which stand for a bus without a name, this one; others stay.
std::string named_local(std::string bus, std::string_view name);

class LocalHub : public Port {
 public:
  /// The names of the nodes that have joined.
  [[nodiscard]] virtual std::vector<std::string> nodes() const = 0;
  /// The node for whose sake the bus stands still; empty: none.
  [[nodiscard]] virtual std::string held_up_by() const = 0;
};

/// How long a hub bears with a node, how many it takes, and who hears of those that it turns away.
struct HubRules {
  std::int64_t hello_limit_ns = 1'000'000'000;  ///< from its connection to its first word
  /// For so long the bus may stand still for a node's sake: less than the 0.4 s for which the bench bears
  /// with a silent target, so that a node which does not read ends nobody's run.
  std::int64_t reading_limit_ns = 250'000'000;
  std::size_t most_nodes = 64;  ///< fewer where the process may open fewer than four times as many files
  std::function<void(const std::string& line)> on_turned_away{};  ///< told at most 20 times
};

/// Founds the bus `local:NAME`; options.fd decides for all whether it carries CAN FD. The hub works only
/// within send() and receive(): call receive() whenever descriptor() is readable. Error: a wrong name, a
/// bus hosted already, or a directory that others may enter.
Result<std::unique_ptr<LocalHub>> host_local_bus(std::string_view bus, const PortOptions& options,
                                                 HubRules rules = {});

/// Joins the bus `local:NAME`. Error: a wrong name, nobody hosts it (it then begins with `nobody_hosts`), its
/// host is another user's process, or it has the other frame format.
Result<std::unique_ptr<Port>> join_local_bus(std::string_view bus, const PortOptions& options);
inline constexpr std::string_view nobody_hosts = "no bus ";

/// Serves a bus that has a hub and no host of its own (`hil-bench bus local:NAME`), until stop(); asks it at
/// least every 100 ms.
void run_hub(Port& hub, const std::function<bool()>& stop);

}  // namespace canhil
