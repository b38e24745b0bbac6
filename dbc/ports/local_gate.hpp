// Admits nodes to the embedded bus and decides which ones to drop.
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
  /// `bus`: the name of the bus, for the lines about nodes that are turned away.
  Gate(Descriptor listener, HubRules rules, std::string bus);

  /// Readable when a node waits for admission.
  [[nodiscard]] int listener() const { return listener_.get(); }
  /// Readable when a node's time limit has expired.
  [[nodiscard]] int alarm() const { return alarm_.descriptor(); }

  /// Admits the next waiting node into `peers`, or refuses it; none: no node was waiting.
  enum class Admission : std::uint8_t { none, refused, admitted };
  Admission admit(std::vector<Peer>& peers);

  /// Drops connections that sent no Hello in time.
  void drop_silent(std::vector<Peer>& peers, bool fd_bus);

  /// Whether the node has stalled the bus for too long and must be dropped.
  [[nodiscard]] bool has_waited_enough(const Peer& peer, std::int64_t now_ns) const;
  void report_dropped_reader(const Peer& peer);
  void report_nonsense(const Peer& peer);

  /// Sets the alarm to the time at which the next node must be dropped.
  void set_alarm(const std::vector<Peer>& peers);

 private:
  void report(std::string_view who, std::string_view what);

  Descriptor listener_;
  HubRules rules_;
  std::string bus_;
  Timer alarm_;
  bool strangers_ = false;  // at the last check some peers had not sent their Hello
  int reported_ = 0;
};

}  // namespace canhil::local
