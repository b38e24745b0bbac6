// Who may be on the embedded bus: whom the hub lets in, with whom it loses patience.
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
  /// `bus`: for the lines that tell of those turned away.
  Gate(Descriptor listener, HubRules rules, std::string bus);

  /// Readable when somebody waits to be let in.
  [[nodiscard]] int listener() const { return listener_.get(); }
  /// Readable when patience() has come to its end.
  [[nodiscard]] int alarm() const { return alarm_.descriptor(); }

  /// Takes the next one that waits: into `peers`, or away with it. Nobody waited: none.
  enum class Admission : std::uint8_t { none, refused, admitted };
  Admission admit(std::vector<Peer>& peers);

  /// Drops those that have connected and said nothing in time.
  void drop_silent(std::vector<Peer>& peers, bool fd_bus);

  /// Whether the bus has waited for the node for long enough; then it is to be dropped.
  [[nodiscard]] bool has_waited_enough(const Peer& peer, std::int64_t now_ns) const;
  void tell_of_dropped_reader(const Peer& peer);
  void tell_of_nonsense(const Peer& peer);

  /// Sets the alarm to when the next of the nodes is to be dropped.
  void set_alarm(const std::vector<Peer>& peers);

 private:
  void tell(std::string_view who, std::string_view what);

  Descriptor listener_;
  HubRules rules_;
  std::string bus_;
  Timer alarm_;
  bool strangers_ = false;  // some peers had said no Hello when last looked at
  int told_ = 0;
};

}  // namespace canhil::local
