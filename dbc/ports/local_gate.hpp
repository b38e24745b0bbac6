// Admits nodes to the embedded bus, and decides which nodes must be dropped.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/ports/local_peer.hpp"
#include "dbc/ports/timer.hpp"

namespace canhil::local {

class Gate {
 public:
  /// `bus` is the name of the bus. It appears in the lines about nodes that are refused or dropped.
  Gate(Descriptor listener, HubRules rules, std::string bus);

  /// A descriptor that is readable when a node waits for admission.
  [[nodiscard]] int listener() const { return listener_.get(); }
  /// A descriptor that is readable when the time limit of a node has expired.
  [[nodiscard]] int alarm() const { return alarm_.descriptor(); }

  /// The result of admit(), which admits the next waiting node into `peers` or refuses it. none: no node was
  /// waiting.
  enum class Admission : std::uint8_t { none, refused, admitted };
  Admission admit(std::vector<Peer>& peers);

  /// Drops the connections from which no Hello came in time.
  void drop_silent(std::vector<Peer>& peers, bool fd_bus);

  /// True if the node has stalled the bus for too long and must be dropped.
  [[nodiscard]] bool has_waited_enough(const Peer& peer, std::int64_t now_ns) const;
  void report_dropped_reader(const Peer& peer);
  void report_nonsense(const Peer& peer);

  /// Sets the alarm to the first time at which the limit of a node expires.
  /// Calls HubRules::on_nodes.
  void count(const std::vector<Peer>& peers) const;
  void set_alarm(const std::vector<Peer>& peers);

 private:
  void report(std::string_view who, std::string_view what);

  Descriptor listener_;
  HubRules rules_;
  std::string bus_;
  Timer alarm_;
  bool strangers_ = false;  // some peers may not have sent their Hello yet
  int reported_ = 0;
};

}  // namespace canhil::local
