// The bench's access to the bus: every frame that passes is shown to the observers, in order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/observe/backlog.hpp"
#include "bench/observe/observer.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::drive {

/// Result of handing over a frame.
enum class LinkState : std::uint8_t { up, congested, down };

/// A port with its observers.
class Link {
 public:
  explicit Link(Port& port) : port_(port) {}

  void attach(observe::Observer& observer) { observers_.push_back(&observer); }
  void detach(observe::Observer& observer) { std::erase(observers_, &observer); }

  /// Hands a frame to the bus. While the bus has no room, or its interface is down, it receives, until
  /// `patience_ns` from now; then `congested` or `down`. `due_ns`: its deadline, if it has one; waiting for
  /// room makes it late.
  LinkState send(const Frame& frame, std::int64_t patience_ns,
                 std::optional<std::int64_t> due_ns = std::nullopt);

  /// Shows waiting frames to the observers, without blocking; `down` once the bus is gone. A bus may bring
  /// frames for ever, so it is `most_at_once` at most: who calls looks at its deadline, and whether it is to
  /// stop, before it calls again. A wait returns at once while more are there.
  LinkState drain();
  static constexpr int most_at_once = 256;  ///< a few of the target's groups; less than a millisecond's work

  /// After `congested`: what came while there was no room, as observe::Shares::to_text(); empty: nothing.
  [[nodiscard]] const std::string& crowd() const { return crowd_; }

  /// The longest time for which frames came faster than they could be looked at; none: they never did.
  [[nodiscard]] const std::optional<observe::Flood>& flood() const { return backlog_.flood(); }

  /// Now on the clock of all deadlines here: Port::monotonic_ns().
  [[nodiscard]] std::int64_t now_ns() const { return port_.monotonic_ns(); }

  /// Port::tell_time(), and the observers.
  void tell_time(std::int64_t t_ns) {
    port_.tell_time(t_ns);
    for (observe::Observer* observer : observers_) observer->time_told(t_ns);
  }

  /// Sleeps until a frame arrives: true; or until `deadline_ns`, or a signal: false.
  bool wait_until(std::int64_t deadline_ns);

  /// Frames that waited for room for longer than a period of Sync after they were due.
  [[nodiscard]] std::uint64_t late_in_queue() const { return late_in_queue_; }

  [[nodiscard]] const Port& port() const { return port_; }

 private:
  void look_at_interface();

  Port& port_;
  std::vector<observe::Observer*> observers_;
  bool up_ = true;
  std::uint64_t late_in_queue_ = 0;
  std::uint64_t overflowed_ = 0;  // when last asked
  observe::Backlog backlog_;
  std::optional<observe::Shares> while_waiting_;  // for room
  std::string crowd_;
};

/// Keeps an observer attached while it lives.
class Attached {
 public:
  Attached(Link& link, observe::Observer& observer) : link_(link), observer_(observer) {
    link_.attach(observer_);
  }
  ~Attached() { link_.detach(observer_); }
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;

 private:
  Link& link_;
  observe::Observer& observer_;
};

}  // namespace canhil::drive
