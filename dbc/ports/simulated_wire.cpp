#include "dbc/ports/simulated_wire.hpp"

#include <algorithm>
#include <utility>

#include "dbc/wire/arbitration.hpp"

namespace canhil {
namespace {

// The error counters and their limits: ISO 11898-1:2015, 12.1.4.
constexpr int error_warning_from = 96;
constexpr int error_passive_above = 127;
constexpr int bus_off_above = 255;
constexpr int transmit_error = 8;
constexpr int receive_error = 1;
// If a receiver reads a dominant bit after its own error flag, its error counter increases by this number.
constexpr int first_to_notice = 8;
constexpr int receive_errors_after_success = 119;
constexpr std::int64_t recovery_runs = 128;
constexpr std::int64_t recessive_run_bits = 11;

using wire::intermission_bits;
constexpr std::int64_t delimiter_bits = 8;
constexpr std::int64_t suspend_bits = 8;
constexpr std::int64_t after_acknowledgement_bits = 1 + 7 + intermission_bits;  // ACK delimiter, end of frame

bool is_passive(int tec, int rec) { return std::max(tec, rec) > error_passive_above; }

BusEvent level_of(int tec, int rec) {
  if (tec > bus_off_above) return BusEvent::bus_off;
  if (is_passive(tec, rec)) return BusEvent::error_passive;
  return std::max(tec, rec) >= error_warning_from ? BusEvent::error_warning : BusEvent::error_active;
}

}  // namespace

SimulatedWire::SimulatedWire(const wire::BitRates& rates, std::vector<WireNode> nodes, Disturb disturb)
    : rates_(rates),
      bit_ns_(wire::duration_ns({.nominal = 1}, rates)),
      disturb_(std::move(disturb)),
      nodes_(nodes.size()) {
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes_[i].setup = nodes[i];
}

std::size_t SimulatedWire::add_node(const WireNode& setup) {
  nodes_.push_back({.setup = setup});
  return nodes_.size() - 1;
}

bool SimulatedWire::queue(std::size_t node, const Frame& frame, std::int64_t t_ns) {
  idle_until(t_ns);
  Node& sender = nodes_[node];
  if (sender.off || sender.queue.size() >= sender.setup.depth) return false;
  sender.queue.push_back(
      {.frame = frame, .rank = wire::arbitration_rank(frame.id, frame.extended), .queued_ns = t_ns});
  return true;
}

std::optional<Carried> SimulatedWire::next(std::int64_t until_ns) {
  for (;;) {
    if (running_) {
      if (running_->over_ns > until_ns) return std::nullopt;
      if (!running_->error) return succeed();
      fail();
      if (has_report())
        return std::nullopt;  // the caller must take the report first: it is older than the next frame
      continue;
    }
    const std::int64_t start_ns = first_start_ns();
    if (start_ns == never ||
        until_ns < start_ns + bit_ns_) {  // until the first bit ends, more nodes may join the arbitration
      idle_until(until_ns);
      return std::nullopt;
    }
    idle_until(start_ns);
    if (const auto from = winner(start_ns)) start(*from, start_ns);
  }
}

std::optional<WireReport> SimulatedWire::report() {
  if (reports_.empty()) return std::nullopt;
  const WireReport report = reports_.front();
  reports_.pop_front();
  return report;
}

std::int64_t SimulatedWire::next_event_ns() const {
  if (running_) return running_->over_ns;
  const std::int64_t start_ns = first_start_ns();
  std::int64_t event_ns = start_ns == never ? never : start_ns + bit_ns_;
  for (const Node& node : nodes_) {
    if (!node.off || !node.setup.reports_errors) continue;
    const std::int64_t runs = recovery_runs - node.recessive_runs;
    event_ns = std::min(event_ns, idle_ns_ + runs * recessive_run_bits * bit_ns_);
  }
  return event_ns;
}

NodeState SimulatedWire::state(std::size_t node) const {
  const Node& n = nodes_[node];
  if (n.off) return NodeState::bus_off;
  return is_passive(n.tec, n.rec) ? NodeState::error_passive : NodeState::error_active;
}

/// The earliest time at which a node with a queued frame may start to send.
std::int64_t SimulatedWire::first_start_ns() const {
  std::int64_t first = never;
  for (const Node& node : nodes_) {
    if (node.queue.empty()) continue;
    first = std::min(first, std::max({free_ns_, node.silent_until_ns, node.queue.front().queued_ns}));
  }
  return first;
}

/// The frame that wins the arbitration. A frame takes part if it is queued before the end of the first bit.
std::optional<SimulatedWire::Candidate> SimulatedWire::winner(std::int64_t start_ns) const {
  const std::int64_t closed_ns = start_ns + bit_ns_;
  std::optional<Candidate> best;
  std::uint32_t best_rank = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    if (node.silent_until_ns >= closed_ns) continue;
    const std::size_t in_reach = node.setup.order == QueueOrder::fifo
                                     ? std::min<std::size_t>(1, node.queue.size())
                                     : node.queue.size();
    for (std::size_t i = 0; i < in_reach && node.queue[i].queued_ns < closed_ns; ++i) {
      if (best && node.queue[i].rank >= best_rank) continue;
      best = Candidate{.node = n, .position = i};
      best_rank = node.queue[i].rank;
    }
  }
  return best;
}

/// True if the frame is acknowledged, i.e. if another node than the sender is on the bus.
bool SimulatedWire::acknowledged(std::size_t sender) const {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (n != sender && !nodes_[n].off) return true;
  }
  return false;
}

/// The error in this attempt to send a frame; nullopt: there is none. The error occurs between the second bit
/// and the end of the frame.
std::optional<WireError> SimulatedWire::error_of(const Attempt& attempt, bool acknowledged) {
  const std::int64_t length_ns = attempt.end_ns - attempt.start_ns;
  std::optional<WireError> error = disturb_ ? disturb_(attempt) : std::nullopt;
  if (error && error->at && state(*error->at) != NodeState::error_active) {
    if (!nodes_[*error->at].off) nodes_[*error->at].rec += receive_error;
    error.reset();  // no other node notices the error, because the error flag of an error passive receiver is
                    // recessive
  }
  if (error) {
    error->after_ns = std::clamp(error->after_ns, bit_ns_, length_ns - intermission_bits * bit_ns_);
    error->flag_bits = std::clamp(error->flag_bits, 6, 12);
  } else if (!acknowledged) {
    error = WireError{.after_ns = length_ns - after_acknowledgement_bits * bit_ns_};
  }
  return error;
}

void SimulatedWire::start(Candidate from, std::int64_t start_ns) {
  Pending& pending = nodes_[from.node].queue[from.position];
  const std::int64_t end_ns = start_ns + wire::duration_ns(wire::bit_length(pending.frame), rates_);
  Running running{.from = from,
                  .attempt = {.node = from.node,
                              .frame = pending.frame,
                              .number = ++pending.attempts,
                              .start_ns = start_ns,
                              .end_ns = end_ns},
                  .acknowledged = acknowledged(from.node),
                  .over_ns = end_ns};
  running.error = error_of(running.attempt, running.acknowledged);
  if (running.error) {
    running.over_ns = start_ns + running.error->after_ns +
                      (running.error->flag_bits + delimiter_bits + intermission_bits) * bit_ns_;
  }
  running_ = running;
}

Carried SimulatedWire::succeed() {
  const auto [node, position] = running_->from;
  Node& sender = nodes_[node];
  const auto at = sender.queue.begin() + static_cast<std::ptrdiff_t>(position);
  const Carried carried{.node = node,
                        .frame = at->frame,
                        .attempts = at->attempts,
                        .queued_ns = at->queued_ns,
                        .start_ns = running_->attempt.start_ns,
                        .delivered_ns = running_->over_ns - intermission_bits * bit_ns_,
                        .end_ns = running_->over_ns};
  sender.queue.erase(at);
  sender.tec = std::max(sender.tec - 1, 0);
  for (Node& other : nodes_) {
    if (&other == &sender || other.off) continue;
    other.rec = other.rec > error_passive_above ? receive_errors_after_success : std::max(other.rec - 1, 0);
  }
  ++counters_.frames;
  for (std::size_t n = 0; n < nodes_.size(); ++n) report_to_host(n, carried.delivered_ns, SeenError::none);
  finish();
  return carried;
}

/// Ends the attempt with an error frame. The frame that was to be sent remains in its queue for the next
/// attempt.
void SimulatedWire::fail() {
  const std::size_t from = running_->from.node;
  const std::int64_t noticed_ns = running_->attempt.start_ns + running_->error->after_ns;
  const bool missed = !running_->acknowledged;
  Node& sender = nodes_[from];
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& other = nodes_[n];
    if (n == from || other.off) continue;
    other.rec += receive_error + (running_->error->at == n ? first_to_notice : 0);
    report_to_host(n, noticed_ns, SeenError::stuff);
  }
  // If there are no other nodes, an error passive sender does not count missing acknowledgements, because
  // these errors must not drive the sender into bus-off.
  if (running_->acknowledged || !is_passive(sender.tec, sender.rec)) sender.tec += transmit_error;
  ++counters_.error_frames;
  report_to_host(from, noticed_ns, missed ? SeenError::acknowledgement : SeenError::bit);
  finish();
  if (sender.tec > bus_off_above) go_off(sender);
}

/// Makes the report in which the controller of a node reports the error `seen` and, if its state has changed,
/// the new state.
void SimulatedWire::report_to_host(std::size_t node, std::int64_t t_ns, SeenError seen) {
  Node& n = nodes_[node];
  if (!n.setup.reports_errors) return;
  const BusEvent level = level_of(n.tec, n.rec);
  ControllerNews news{.seen = seen, .tx_counter = n.tec, .rx_counter = n.rec};
  if (level != n.level) news.event = n.level == BusEvent::bus_off ? BusEvent::restarted : level;
  n.level = level;
  if (seen == SeenError::none && !news.event) return;
  reports_.push_back({.node = node, .frame = error_frame(news), .t_ns = t_ns});
}

void SimulatedWire::go_off(Node& node) {
  node.off = true;
  node.recessive_runs = 0;
  counters_.dropped += node.queue.size();
  node.queue.clear();
}

void SimulatedWire::finish() {
  Node& sender = nodes_[running_->from.node];
  free_ns_ = running_->over_ns;
  idle_ns_ = free_ns_;
  counters_.busy_ns += running_->over_ns - running_->attempt.start_ns;
  if (is_passive(sender.tec, sender.rec)) sender.silent_until_ns = free_ns_ + suspend_bits * bit_ns_;
  running_.reset();
  see_recessive(1,
                // One run of recessive bits: the delimiter, the end of frame (or the rest of the error frame)
                // and the intermission.
                free_ns_);
}

/// Counts the recessive bits of the idle bus up to t_ns.
void SimulatedWire::idle_until(std::int64_t t_ns) {
  if (running_ || t_ns <= idle_ns_) return;
  const std::int64_t runs = (t_ns - idle_ns_) / (recessive_run_bits * bit_ns_);
  idle_ns_ += runs * recessive_run_bits * bit_ns_;
  see_recessive(runs, idle_ns_);
}

/// Counts `runs` more runs of 11 recessive bits each. The last of these runs ends at last_ns. After 128 runs,
/// a bus-off node takes part in the bus again.
void SimulatedWire::see_recessive(std::int64_t runs, std::int64_t last_ns) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    if (!node.off) continue;
    const std::int64_t missing = recovery_runs - node.recessive_runs;
    node.recessive_runs += std::min(runs, missing);
    if (runs < missing) continue;
    node = Node{.setup = node.setup, .level = BusEvent::bus_off};
    report_to_host(n, last_ns - (runs - missing) * recessive_run_bits * bit_ns_, SeenError::none);
  }
}

}  // namespace canhil
