// The bench's access to the bus. Observers see every frame that passes, in order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/observe/backlog.hpp"
#include "bench/observe/observer.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::drive {

/// Result of sending a frame.
enum class LinkState : std::uint8_t { up, congested, down };

/// A port with its observers.
class Link {
 public:
  explicit Link(Port& port) : port_(port) {}

  void attach(observe::Observer& observer) { observers_.push_back(&observer); }
  void detach(observe::Observer& observer) { std::erase(observers_, &observer); }

  /// Sends a frame. While the bus is full or its interface is down, send() receives frames for up to
  /// `patience_ns`; then send() returns `congested` or `down`. `due_ns`: the frame's deadline, if any;
  /// waiting for room makes the frame late.
  LinkState send(const Frame& frame, std::int64_t patience_ns,
                 std::optional<std::int64_t> due_ns = std::nullopt);

  /// The same for frames without a deadline that are sent together.
  LinkState send_all(std::span<const Frame> frames, std::int64_t patience_ns);

  /// Keeps frames until flush() sends them together; observers see them at once. For virtual time: each
  /// message may wake the target, which costs more than its frames, and nobody needs them before the bench
  /// waits for an answer. A device in this process gets them at once.
  LinkState post(std::span<const Frame> frames, std::int64_t patience_ns);
  /// Sends the frames that post() has kept.
  LinkState flush(std::int64_t patience_ns);

  /// Receives the frames that are waiting and passes them to the observers, without blocking. Returns `down`
  /// if the bus is gone. A bus may deliver frames without end, so one call takes at most `most_at_once`
  /// frames: before the next call the caller must check its deadline and whether to stop. While more frames
  /// are waiting, wait_until() returns at once.
  LinkState drain();
  static constexpr int most_at_once = 256;  ///< enough for several groups of the target; takes less than a
                                            ///< millisecond

  /// Describes the frames that arrived while send() waited, if send() then gave up. The form is that of
  /// observe::Shares::to_text(). Empty: no frames arrived.
  [[nodiscard]] const std::string& crowd() const { return crowd_; }

  /// The longest interval in which frames came faster than they could be processed; none: there was no such
  /// interval.
  [[nodiscard]] const std::optional<observe::Flood>& flood() const { return backlog_.flood(); }

  /// The current time on the clock of all deadlines: Port::monotonic_ns().
  [[nodiscard]] std::int64_t now_ns() const { return port_.monotonic_ns(); }

  /// Passes the virtual time to the port and the observers.
  void set_time(std::int64_t t_ns) {
    port_.set_time(t_ns);
    for (observe::Observer* observer : observers_) observer->time_set(t_ns);
  }

  /// Sleeps until a frame arrives, and then returns true. Returns false at `deadline_ns` or after a signal.
  bool wait_until(std::int64_t deadline_ns);

  /// The number of frames that waited for room and were late when the bus took them: later than their
  /// deadline by more than one period of Sync.
  [[nodiscard]] std::uint64_t late_in_queue() const { return late_in_queue_; }

  [[nodiscard]] const Port& port() const { return port_; }

 private:
  void tell_sent(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns);
  SendOutcome try_to_send(const Frame& frame, std::optional<std::int64_t> due_ns, std::int64_t& late_ns);
  LinkState send_again(const Frame& frame, std::int64_t patience_ns, std::optional<std::int64_t> due_ns,
                       SendOutcome outcome);
  void look_at_interface();

  Port& port_;
  std::vector<observe::Observer*> observers_;
  std::vector<Frame> posted_;
  bool told_ = false;  // the observers have seen the frames that are being sent: those of post()
  bool up_ = true;
  std::uint64_t late_in_queue_ = 0;
  std::uint64_t overflowed_ = 0;  // the port's count at the last check
  observe::Backlog backlog_;
  std::optional<observe::Shares> while_waiting_;  // frames received while waiting for room in the queue
  std::string crowd_;
};

/// Keeps an observer attached during its lifetime.
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
