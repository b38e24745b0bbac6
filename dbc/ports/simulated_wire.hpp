// A CAN bus as a model in time: arbitration, frames of their exact length, transmit queues, error frames with
// retransmission, error counters. No socket, no clock, no thread: whoever holds it says what time it is.
//
// After Bosch CAN 2.0 and ISO 11898-1:2015. A node joins the arbitration if it has a frame before the first
// bit of the frame on the wire is over. Errors come from outside (Disturb); which nodes notice, and what it
// costs them, is in the model, and what their controllers tell of it. Left out: overload frames, and two
// nodes that send the same id at once (the node with the lower number then sends first).
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

/// What a node sends first: the frame of highest priority, or the oldest (as SocketCAN's queues do).
enum class QueueOrder : std::uint8_t { priority, fifo };

enum class NodeState : std::uint8_t { error_active, error_passive, bus_off };

struct WireNode {
  QueueOrder order = QueueOrder::priority;
  std::size_t depth = 64;  ///< frames that can wait, the one on the wire among them
  bool told = false;       ///< its controller reports errors, see SimulatedWire::report()
};

/// One try to send a frame.
struct Attempt {
  std::size_t node = 0;
  Frame frame{};
  int number = 1;  ///< counts from 1
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;  ///< of the intermission, if nothing goes wrong
};

/// An error on the wire: an error flag begins so long after the start of the frame.
struct WireError {
  std::int64_t after_ns = 0;
  std::optional<std::size_t> at{};  ///< the receiver that alone noticed it; none: all nodes did
  int flag_bits = 6;                ///< 6, up to 12 where flags follow one another
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
  std::int64_t delivered_ns = 0;  ///< the end of frame is over: all receivers have it
  std::int64_t end_ns = 0;        ///< the intermission is over: the next frame may start
};

/// What the controller of a node tells its host, as an error frame of Linux.
struct WireReport {
  std::size_t node = 0;
  Frame frame{};
  std::int64_t t_ns = 0;
};

struct WireCounters {
  std::uint64_t frames = 0;
  std::uint64_t error_frames = 0;
  std::uint64_t dropped = 0;  ///< frames that waited in a node as it went off the bus
  std::int64_t busy_ns = 0;   ///< frames and error frames, with their intermissions
};

class SimulatedWire {
 public:
  SimulatedWire(const wire::BitRates& rates, std::vector<WireNode> nodes, Disturb disturb = {});

  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  /// One more node; gives its number.
  std::size_t add_node(const WireNode& setup);

  /// Puts a frame into a node's queue at t_ns, which is no earlier than at any call before; what answers the
  /// frame that next() gave last may be queued at its delivered_ns. False: the queue is full or the node is
  /// off the bus, and the frame was not taken.
  bool queue(std::size_t node, const Frame& frame, std::int64_t t_ns);

  /// The next frame that is sent by until_ns; none: ask again later, or at once if has_report() says so. All
  /// that was queued before until_ns must have been.
  std::optional<Carried> next(std::int64_t until_ns);

  /// The next report of a node that is `told`, in the order of time. Those that are there when next() gives a
  /// frame come after it.
  std::optional<WireReport> report();
  [[nodiscard]] bool has_report() const { return !reports_.empty(); }

  /// From when on next() can have more to say; never: not before a frame is queued.
  [[nodiscard]] std::int64_t next_event_ns() const;

  /// As of the last call of queue() or next().
  [[nodiscard]] NodeState state(std::size_t node) const;
  [[nodiscard]] int transmit_errors(std::size_t node) const { return nodes_[node].tec; }
  [[nodiscard]] int receive_errors(std::size_t node) const { return nodes_[node].rec; }
  [[nodiscard]] std::size_t waiting(std::size_t node) const { return nodes_[node].queue.size(); }
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
    std::int64_t silent_until_ns = long_ago;  ///< an error passive sender lets others go first
    bool off = false;
    std::int64_t recessive_runs = 0;          ///< of 11 bits, while off
    BusEvent level = BusEvent::error_active;  ///< the last one that it told of
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
    std::int64_t over_ns = 0;  ///< of the frame or the error frame, with the intermission
  };

  [[nodiscard]] std::int64_t first_start_ns() const;
  [[nodiscard]] std::optional<Candidate> winner(std::int64_t start_ns) const;
  [[nodiscard]] bool acknowledged(std::size_t sender) const;
  [[nodiscard]] std::optional<WireError> error_of(const Attempt& attempt, bool acknowledged);
  void start(Candidate from, std::int64_t start_ns);
  Carried succeed();
  void fail();
  void go_off(Node& node);
  void tell(std::size_t node, std::int64_t t_ns, SeenError seen);
  void finish();
  void idle_until(std::int64_t t_ns);
  void see_recessive(std::int64_t runs, std::int64_t last_ns);

  wire::BitRates rates_;
  std::int64_t bit_ns_;
  Disturb disturb_;
  std::vector<Node> nodes_;
  std::optional<Running> running_{};
  std::int64_t free_ns_ = long_ago;  ///< nothing is on the wire since
  std::int64_t idle_ns_ = free_ns_;  ///< up to here the recessive bits since then are counted
  std::deque<WireReport> reports_{};
  WireCounters counters_{};
};

}  // namespace canhil
