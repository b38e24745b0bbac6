// The embedded bus `local:NAME`: CAN between processes of one machine, where the kernel has no AF_CAN.
//
// The host's port is the hub. Each node has one Unix SOCK_SEQPACKET connection to it, so a frame takes one
// hop between host and node, two between nodes. The hub decides the bus order and stamps each frame
// (CLOCK_MONOTONIC). No frame is lost: every frame that send() accepts reaches all nodes, in the same order.
// While one node has no room, the bus stalls until that node reads or dies; senders see queue_full. Every
// node must therefore read: the hub drops a node that stalls the bus for too long.
//
// A bus belongs to one user: its sockets are in a directory of mode 0700 (`canhil` in XDG_RUNTIME_DIR, else
// /tmp/canhil-uid-UID), and host and node each check the user of the other process (SO_PEERCRED).
//
// `local:NAME?bitrate=500000` adds a simulated wire (simulated_wire.hpp) that runs in real time: a frame
// takes the time of its bits, the lowest id wins, and every node has a queue of 64 frames, which it sends in
// the order of queueing or, with `&queue=priority`, of priority. `&data-bitrate=2000000` sets the data bit
// rate of CAN FD. The stamp is the end of the frame on that wire, exact to the nanosecond even if the hub's
// process runs late.
// `&bit-error-rate=1e-6&seed=3` adds bit errors: a node then receives the error frames of its own controller
// and loses its queued frames when that controller goes bus-off. Only the host needs these settings.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "dbc/ports/port.hpp"

namespace canhil {

/// The prefix of the name of every embedded bus.
inline constexpr std::string_view local_prefix = "local:";
/// True for the name of an embedded bus.
constexpr bool is_local(std::string_view bus) { return bus.starts_with(local_prefix); }
/// Inserts the name into `local:` and `local:?bitrate=500000`, which have none; does not change other buses.
std::string named_local(std::string bus, std::string_view name);

/// The host's port of an embedded bus.
class LocalHub : public Port {
 public:
  /// The names of the nodes that have joined.
  [[nodiscard]] virtual std::vector<std::string> nodes() const = 0;
  /// The node that stalls the bus; empty: none.
  [[nodiscard]] virtual std::string held_up_by() const = 0;
};

/// The hub's limits for nodes, and a callback for nodes that it turns away.
struct HubRules {
  std::int64_t hello_limit_ns = 1'000'000'000;  ///< longest time from a node's connection to its Hello
  /// How long a node may stall the bus. The limit is shorter than the 0.4 s for which the bench tolerates
  /// a silent target, so that a node that does not read cannot end a run.
  std::int64_t reading_limit_ns = 250'000'000;
  std::size_t most_nodes = 64;  ///< lowered to a quarter of the process's limit of open files
  std::function<void(const std::string& line)> on_turned_away{};  ///< called at most 20 times
};

/// Hosts the bus `local:NAME`; options.fd decides whether it carries CAN FD. The hub works only within send()
/// and receive(): call receive() whenever descriptor() is readable. Error: an invalid name, a bus that is
/// hosted already, or a directory that others may enter.
Result<std::unique_ptr<LocalHub>> host_local_bus(std::string_view bus, const PortOptions& options,
                                                 HubRules rules = {});

/// Joins the bus `local:NAME`. Error: an invalid name, no host (the error then begins with `nobody_hosts`), a
/// host of another user, or the other frame format.
Result<std::unique_ptr<Port>> join_local_bus(std::string_view bus, const PortOptions& options);
/// How the error of join_local_bus() begins where no process hosts the bus.
inline constexpr std::string_view nobody_hosts = "no bus ";

/// Serves a bus without a bench (`hil-bench bus local:NAME`) until stop() is true; calls stop() at least
/// every 100 ms.
void run_hub(Port& hub, const std::function<bool()>& stop);

}  // namespace canhil
