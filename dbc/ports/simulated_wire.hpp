// A model of the timing of a CAN bus: arbitration, exact lengths of frames, transmit queues, error frames
// with retransmission, and error counters. The model uses no socket, no clock and no thread: the owner passes
// the time to each call.
//
// The model follows Bosch CAN 2.0 and ISO 11898-1:2015. A node takes part in an arbitration if it has a frame
// before the end of the first bit on the wire. A callback (Disturb) injects errors. The model decides which
// nodes notice the errors, updates the error counters, and makes the reports of the controllers. Two things
// are not modelled: overload frames, and collisions of two nodes that send the same id. In such a collision,
// the node with the lower number sends first.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "dbc/ports/bus_errors.hpp"
#include "dbc/wire/bit_length.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil {

/// Which frame a node sends first: the frame with the highest priority, or the oldest frame (as SocketCAN's
/// queues do).
enum class QueueOrder : std::uint8_t { priority, fifo };

/// The states of a CAN controller (ISO 11898-1:2015, fault confinement).
enum class NodeState : std::uint8_t { error_active, error_passive, bus_off };

/// The properties of a node on the wire.
struct WireNode {
  QueueOrder order = QueueOrder::priority;
  std::size_t depth = 64;       ///< size of the queue in frames; the frame on the wire is one of them
  bool reports_errors = false;  ///< the controller of the node reports errors, see SimulatedWire::report()
};

/// One attempt to send a frame.
struct Attempt {
  std::size_t node = 0;
  Frame frame{};
  int number = 1;  ///< number of the attempt for this frame; the first is 1
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;  ///< end of the intermission, if no error occurs
};

/// An error on the wire. The error flag begins `after_ns` after the start of the frame.
struct WireError {
  std::int64_t after_ns = 0;
  std::optional<std::size_t>
      at{};           ///< the only receiver that noticed the error; nullopt: all nodes noticed it
  int flag_bits = 6;  ///< 6; up to 12 if error flags follow one another
};

/// A function that is called before each attempt and decides whether an error occurs in it.
using Disturb = std::function<std::optional<WireError>(const Attempt&)>;

/// A frame that was sent.
struct Carried {
  std::size_t node = 0;
  Frame frame{};
  int attempts = 1;
  std::int64_t queued_ns = 0;
  std::int64_t start_ns = 0;      ///< start of the attempt that succeeded
  std::int64_t delivered_ns = 0;  ///< end of the end-of-frame field, when all receivers have the frame
  std::int64_t end_ns = 0;        ///< end of the intermission, when the next frame may start
};

/// A report of the controller of a node to its host computer, as a Linux error frame.
struct WireReport {
  std::size_t node = 0;
  Frame frame{};
  std::int64_t t_ns = 0;
};

/// The counters of the wire since the start.
struct WireCounters {
  std::uint64_t frames = 0;
  std::uint64_t error_frames = 0;
  std::uint64_t dropped = 0;  ///< frames that were lost because their node went bus-off
  std::int64_t busy_ns = 0;   ///< total duration of frames and error frames, with their intermissions
};

/// A CAN bus in virtual time, with arbitration, exact lengths of frames, errors and error counters.
class SimulatedWire {
 public:
  /// Makes a wire with these bit rates and nodes. If `disturb` is empty, there are no errors.
  SimulatedWire(const wire::BitRates& rates, std::vector<WireNode> nodes, Disturb disturb = {});

  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  /// Adds a node and returns its number.
  std::size_t add_node(const WireNode& setup);

  /// Puts a frame into the queue of a node at the time t_ns. Times must not decrease from call to call.
  /// Exception: an answer to the frame that next() returned last may be queued at the delivered_ns of that
  /// frame. False: the frame was not queued, because the queue is full or the node is bus-off.
  bool queue(std::size_t node, const Frame& frame, std::int64_t t_ns);

  /// The next frame whose transmission, with the intermission, ends by until_ns. nullopt: there is no such
  /// frame; if has_report() is true, call report() and then next() again. All frames that are due before
  /// until_ns must be queued before this call.
  std::optional<Carried> next(std::int64_t until_ns);

  /// The next report of a node with reports_errors; nullopt: there is none. Reports are in order of time. If
  /// the caller takes all reports before each call of next(), then every report that exists after next() has
  /// returned a frame has a time at or after the delivered_ns of this frame.
  std::optional<WireReport> report();
  /// True if report() would return a report.
  [[nodiscard]] bool has_report() const { return !reports_.empty(); }

  /// The time at which next() can return another frame or report; `never`: only after another frame has been
  /// queued.
  [[nodiscard]] std::int64_t next_event_ns() const;

  /// The state of a node at the last call of queue() or next().
  [[nodiscard]] NodeState state(std::size_t node) const;
  /// The transmit error counter of a node.
  [[nodiscard]] int transmit_errors(std::size_t node) const { return nodes_[node].tec; }
  /// The receive error counter of a node.
  [[nodiscard]] int receive_errors(std::size_t node) const { return nodes_[node].rec; }
  /// The number of frames in the queue of a node.
  [[nodiscard]] std::size_t waiting(std::size_t node) const { return nodes_[node].queue.size(); }
  /// The counters so far.
  [[nodiscard]] const WireCounters& counters() const { return counters_; }

 private:
  static constexpr std::int64_t long_ago = std::numeric_limits<std::int64_t>::min() / 2;

  struct Pending {
    Frame frame;
    std::uint32_t rank = 0;
    std::int64_t queued_ns = 0;
    int attempts = 0;
  };
  struct Node {
    WireNode setup{};
    std::vector<Pending> queue{};  ///< oldest first
    int tec = 0;
    int rec = 0;
    std::int64_t silent_until_ns =
        long_ago;  ///< an error passive sender must wait until then (suspend transmission)
    bool off = false;
    std::int64_t recessive_runs = 0;  ///< number of runs of 11 recessive bits since the node went bus-off
    BusEvent level = BusEvent::error_active;  ///< the last reported state
  };
  struct Candidate {
    std::size_t node = 0;
    std::size_t position = 0;
  };
  struct Running {
    Candidate from{};
    Attempt attempt{};
    std::optional<WireError> error{};
    bool acknowledged = true;
    std::int64_t over_ns = 0;  ///< end of the intermission after the frame or error frame
  };

  [[nodiscard]] std::int64_t first_start_ns() const;
  [[nodiscard]] std::optional<Candidate> winner(std::int64_t start_ns) const;
  [[nodiscard]] bool acknowledged(std::size_t sender) const;
  [[nodiscard]] std::optional<WireError> error_of(const Attempt& attempt, bool acknowledged);
  void start(Candidate from, std::int64_t start_ns);
  Carried succeed();
  void fail();
  void go_off(Node& node);
  void report_to_host(std::size_t node, std::int64_t t_ns, SeenError seen);
  void finish();
  void idle_until(std::int64_t t_ns);
  void see_recessive(std::int64_t runs, std::int64_t last_ns);

  wire::BitRates rates_;
  std::int64_t bit_ns_;
  Disturb disturb_;
  std::vector<Node> nodes_;
  std::optional<Running> running_{};
  std::int64_t free_ns_ = long_ago;  ///< the time since which the wire has been free
  std::int64_t idle_ns_ =
      free_ns_;  ///< up to this time, the recessive bits of the free wire have been counted
  std::deque<WireReport> reports_{};
  WireCounters counters_{};
};

}  // namespace canhil
