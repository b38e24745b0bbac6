// A CAN bus as a model in time: arbitration, frames of their exact length, transmit queues, error frames with
// retransmission, error counters. No socket, no clock, no thread: the owner passes the time to each call.
//
// After Bosch CAN 2.0 and ISO 11898-1:2015. A node joins the arbitration if it has a frame before the first
// bit of the frame on the wire ends. A callback (Disturb) injects errors; the model decides which nodes
// notice them, updates the error counters, and generates the reports of the controllers. Not modelled:
// overload frames, and collisions of two nodes that send the same id (the node with the lower number sends
// first).
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

/// Which frame a node sends first: the one with the highest priority, or the oldest (like SocketCAN's
/// queues).
enum class QueueOrder : std::uint8_t { priority, fifo };

/// The states of a CAN controller (ISO 11898-1:2015, fault confinement).
enum class NodeState : std::uint8_t { error_active, error_passive, bus_off };

/// The properties of a node on the wire.
struct WireNode {
  QueueOrder order = QueueOrder::priority;
  std::size_t depth = 64;       ///< of the queue, in frames, including the one on the wire
  bool reports_errors = false;  ///< its controller reports errors, see SimulatedWire::report()
};

/// One attempt to send a frame.
struct Attempt {
  std::size_t node = 0;
  Frame frame{};
  int number = 1;  ///< counts from 1
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;  ///< end of the intermission, if no error occurs
};

/// An error on the wire: an error flag begins `after_ns` after the start of the frame.
struct WireError {
  std::int64_t after_ns = 0;
  std::optional<std::size_t> at{};  ///< the only receiver that noticed it; none: all nodes did
  int flag_bits = 6;                ///< 6, up to 12 if flags follow one another
};

/// Decides before each attempt whether an error hits it.
using Disturb = std::function<std::optional<WireError>(const Attempt&)>;

/// A frame that was sent.
struct Carried {
  std::size_t node = 0;
  Frame frame{};
  int attempts = 1;
  std::int64_t queued_ns = 0;
  std::int64_t start_ns = 0;      ///< of the attempt that succeeded
  std::int64_t delivered_ns = 0;  ///< end of the end-of-frame field: all receivers have the frame
  std::int64_t end_ns = 0;        ///< end of the intermission: the next frame may start
};

/// A report from a node's controller to its host, as a Linux error frame.
struct WireReport {
  std::size_t node = 0;
  Frame frame{};
  std::int64_t t_ns = 0;
};

/// What the wire has counted since the start.
struct WireCounters {
  std::uint64_t frames = 0;
  std::uint64_t error_frames = 0;
  std::uint64_t dropped = 0;  ///< frames in the queues of nodes that went bus-off
  std::int64_t busy_ns = 0;   ///< frames and error frames, with their intermissions
};

/// A CAN bus in virtual time: arbitration, exact lengths of frames, errors and their counters.
class SimulatedWire {
 public:
  /// A wire with these bit rates and nodes; without `disturb` there are no errors.
  SimulatedWire(const wire::BitRates& rates, std::vector<WireNode> nodes, Disturb disturb = {});

  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  /// Adds a node and returns its number.
  std::size_t add_node(const WireNode& setup);

  /// Puts a frame into a node's queue at t_ns. Times must not decrease from call to call, except that an
  /// answer to the frame that next() returned last may be queued at its delivered_ns. False: the frame was
  /// not queued, as the queue is full or the node is bus-off.
  bool queue(std::size_t node, const Frame& frame, std::int64_t t_ns);

  /// The next frame that has been sent, with its intermission, by until_ns; none: call again later, or after
  /// report() if has_report(). All frames due before until_ns must be queued first.
  std::optional<Carried> next(std::int64_t until_ns);

  /// The next report of a node with reports_errors, in order of time. If the caller takes all
  /// reports before it calls next(), the reports that exist when next() returns a frame are not earlier than
  /// its delivered_ns.
  std::optional<WireReport> report();
  /// True if report() has something.
  [[nodiscard]] bool has_report() const { return !reports_.empty(); }

  /// When next() can return more; `never`: only after another frame is queued.
  [[nodiscard]] std::int64_t next_event_ns() const;

  /// The state at the last call of queue() or next().
  [[nodiscard]] NodeState state(std::size_t node) const;
  /// The transmit error counter of a node.
  [[nodiscard]] int transmit_errors(std::size_t node) const { return nodes_[node].tec; }
  /// The receive error counter of a node.
  [[nodiscard]] int receive_errors(std::size_t node) const { return nodes_[node].rec; }
  /// The number of frames in a node's queue.
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
    std::int64_t silent_until_ns = long_ago;  ///< end of the suspend transmission of an error passive sender
    bool off = false;
    std::int64_t recessive_runs = 0;          ///< runs of 11 recessive bits since the node went bus-off
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
    std::int64_t over_ns = 0;  ///< end of the frame or error frame, with the intermission
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
  std::int64_t idle_ns_ = free_ns_;  ///< the recessive bits of the free wire are counted up to this time
  std::deque<WireReport> reports_{};
  WireCounters counters_{};
};

}  // namespace canhil
