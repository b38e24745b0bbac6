// The bench's access to the bus: every frame that passes is shown to the observers, in order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/backlog.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::run {

/// Sees every frame of a run. Times are of the port's stamp clock [ns].
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;
  /// The bench handed a frame to the bus. `late_ns`: after its deadline; 0 where there was none.
  virtual void transmitted(const Frame& /*frame*/, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) {}
  /// A frame came from the bus; `received.own`: the echo of one of ours, with its transmit stamp.
  virtual void received(const Received& /*received*/) {}
  /// A frame came that is not of this bus's format: no part of the run.
  virtual void foreign(const Received& /*received*/) {}
  /// The interface went down or was removed, or is back.
  virtual void interface_changed(bool /*up*/, std::int64_t /*t_ns*/) {}
};

/// Result of handing over a frame.
enum class LinkState : std::uint8_t { up, congested, down };

/// A port with its observers.
class Link {
 public:
  explicit Link(Port& port) : port_(port) {}

  void attach(Observer& observer) { observers_.push_back(&observer); }
  void detach(Observer& observer) { std::erase(observers_, &observer); }

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

  /// After `congested`: what came while there was no room, as Shares::words(); empty: nothing.
  [[nodiscard]] const std::string& crowd() const { return crowd_; }

  /// The longest time for which frames came faster than they could be looked at; none: they never did.
  [[nodiscard]] const std::optional<Flood>& flood() const { return backlog_.flood(); }

  /// Now on the clock of all deadlines here: Port::monotonic_ns().
  [[nodiscard]] std::int64_t now_ns() const { return port_.monotonic_ns(); }

  /// Port::tell_time().
  void tell_time(std::int64_t t_ns) { port_.tell_time(t_ns); }

  /// Sleeps until a frame arrives: true; or until `deadline_ns`, or a signal: false.
  bool wait_until(std::int64_t deadline_ns);

  /// Frames that waited for room for longer than a period of Sync after they were due.
  [[nodiscard]] std::uint64_t late_in_queue() const { return late_in_queue_; }

  [[nodiscard]] const Port& port() const { return port_; }

 private:
  void look_at_interface();

  Port& port_;
  std::vector<Observer*> observers_;
  bool up_ = true;
  std::uint64_t late_in_queue_ = 0;
  std::uint64_t overflowed_ = 0;  // when last asked
  Backlog backlog_;
  std::optional<Shares> while_waiting_;  // for room
  std::string crowd_;
};

/// Keeps an observer attached while it lives.
class Attached {
 public:
  Attached(Link& link, Observer& observer) : link_(link), observer_(observer) { link_.attach(observer_); }
  ~Attached() { link_.detach(observer_); }
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;

 private:
  Link& link_;
  Observer& observer_;
};

}  // namespace canhil::run
