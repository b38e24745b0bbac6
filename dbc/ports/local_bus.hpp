// The embedded bus `local:NAME`: CAN between processes of one machine, where the kernel has no AF_CAN.
//
// The port of the host is the hub. Each node has one Unix SOCK_SEQPACKET connection to the hub. So a frame
// from the host to a node, or from a node to the host, takes one connection; a frame from one node to another
// takes two connections. The hub decides the order of the frames and gives each frame a time stamp
// (CLOCK_MONOTONIC). No frame is lost: every frame that send() accepts reaches all nodes, in the same order.
// If a node has no room for a frame, the bus stalls until this node reads or dies; meanwhile send() returns
// queue_full. Therefore every node must read its frames: the hub drops a node that stalls the bus for too
// long.
//
// A bus belongs to one user. Its sockets are in a directory of mode 0700 (`canhil` in XDG_RUNTIME_DIR,
// otherwise /tmp/canhil-uid-UID). In addition, the host checks the user of each node, and each node checks
// the user of the host (SO_PEERCRED).
//
// `local:NAME?bitrate=500000` adds a simulated wire (simulated_wire.hpp) that works in real time: a frame
// takes the time of its bits, and the lowest id wins the arbitration. Every node has a queue of 64 frames,
// which it sends in the order of queueing or, with `&queue=priority`, in the order of priority.
// `&data-bitrate=2000000` sets the data bit rate of CAN FD. The time stamp is the end of the frame on the
// wire; it is exact to the nanosecond, even if the process of the hub runs late.
// `&bit-error-rate=1e-6&seed=3` adds bit errors. A node then receives the error frames of its own controller,
// and loses its queued frames when this controller goes bus-off. Only the host needs these settings.
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
/// If `bus` is an embedded bus without a name, such as `local:` or `local:?bitrate=500000`, inserts `name`.
/// Returns other buses unchanged.
std::string named_local(std::string bus, std::string_view name);

/// The port of the process that hosts an embedded bus.
class LocalHub : public Port {
 public:
  /// The names of the nodes that have joined.
  [[nodiscard]] virtual std::vector<std::string> nodes() const = 0;
  /// The name of the node that stalls the bus; empty: no node stalls it.
  [[nodiscard]] virtual std::string held_up_by() const = 0;
};

/// The limits that the hub sets for nodes, and a callback for nodes that the hub refuses or drops.
struct HubRules {
  std::int64_t hello_limit_ns = 1'000'000'000;  ///< longest time from a connection to its Hello
  /// How long a node may stall the bus. This is shorter than the 0.4 s for which the bench tolerates a silent
  /// target, so that a node which does not read its frames cannot end a run.
  std::int64_t reading_limit_ns = 250'000'000;
  std::size_t most_nodes = 64;  ///< at most a quarter of the process's limit of open files
  std::function<void(const std::string& line)>
      on_turned_away{};  ///< receives a line for each such node, at most 20
  /// Receives the number of nodes that have joined: 0 when the bus begins, then after each change.
  std::function<void(std::size_t nodes)> on_nodes{};
};

/// Hosts the bus `local:NAME`. If options.fd is true, the bus carries CAN FD. The hub works only inside
/// send() and receive(); therefore call receive() whenever descriptor() is readable. Returns an error if the
/// name is invalid, if the bus is hosted already, or if other users may enter the directory.
Result<std::unique_ptr<LocalHub>> host_local_bus(std::string_view bus, const PortOptions& options,
                                                 HubRules rules = {});

/// Joins the bus `local:NAME`. Returns an error if the name is invalid, if no process hosts the bus (then the
/// error begins with `nobody_hosts`), if the host belongs to another user, or if the frame format of the bus
/// (classic or FD) is not that of options.fd.
Result<std::unique_ptr<Port>> join_local_bus(std::string_view bus, const PortOptions& options);
/// The beginning of the error that join_local_bus() returns if no process hosts the bus.
inline constexpr std::string_view nobody_hosts = "no bus ";

/// Hosts a bus that needs no bench (`hil-bench bus local:NAME`) until stop() returns true. Calls stop() at
/// least every 100 ms.
void run_hub(Port& hub, const std::function<bool()>& stop);

}  // namespace canhil
