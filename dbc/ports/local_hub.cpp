// The hub of the embedded bus, which is the port of the host.
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "dbc/ports/datagram_batch.hpp"
#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/hub_wire.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/ports/local_gate.hpp"
#include "dbc/ports/local_peer.hpp"
#include "dbc/ports/local_place.hpp"
#include "dbc/ports/local_wire.hpp"
#include "dbc/ports/ready_queue.hpp"
#include "dbc/ports/watched.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil {
namespace {

using local::Datagram;
using local::Format;
using local::Gate;
using local::HubWire;
using local::Peer;
using local::Reading;
using Wake = local::ReadyQueue::Wake;

constexpr int backlog = 64;                // how many connections may wait for accept()
constexpr std::size_t ready_limit = 4096;  // how many frames may wait until the host receives them
constexpr int accept_every = 64;           // the hub looks for new nodes at least once in so many reads
// Nodes may send, join and leave without a pause. Therefore one call handles at most this number of these
// events. If more events are waiting, the descriptor remains readable.
constexpr int most_at_once = 256;
constexpr int most_let_in = 4;  // nodes admitted in one call: this takes far longer than a frame

class Hub final : public LocalHub {
 public:
  Hub(local::Claim claim, Gate gate, std::string name, const PortOptions& options, local::IdSet wanted,
      std::optional<HubWire> wire)
      : claim_(std::move(claim)),
        gate_(std::move(gate)),
        name_(std::move(name)),
        fd_(options.fd),
        only_some_(!options.only_ids.empty()),
        wanted_(wanted),
        own_echo_(options.own_echo),
        wire_(std::move(wire)) {
    if (own_echo_ || wire_) events_.watch(ready_.enable_wake(), EPOLLIN);
    if (wire_) events_.watch(wire_->descriptor(), EPOLLIN);
    events_.watch(gate_.alarm(), EPOLLIN);
    events_.watch(gate_.listener(), EPOLLIN);
    gate_.count(peers_);
  }

  SendOutcome send(const Frame& frame) override {
    if (!can_carry(frame, fd_)) return SendOutcome::refused;
    if (wire_ && !frame.error) return send_over_wire(frame);
    if (!catch_up() || ready_.size() >= ready_limit) return SendOutcome::queue_full;
    Datagram datagram;
    local::encode(frame, datagram);
    datagram.t_ns = clock_ns(CLOCK_MONOTONIC);
    deliver(datagram, no_origin);
    if (own_echo_ && wants(frame)) ready_.push(frame, datagram.t_ns, true, Wake::yes);
    ++counters_.sent;
    return SendOutcome::sent;
  }

  /// Usually the bus has one other node, which gets all frames.
  std::size_t send_all(std::span<const Frame> frames) override {
    const bool usual = !wire_ && catch_up() && peers_.size() == 1 && local::gets_all(peers_.front());
    if (frames.size() == 1 || !usual || ready_.size() >= ready_limit) return Port::send_all(frames);
    const std::int64_t t_ns = clock_ns(CLOCK_MONOTONIC);
    const std::size_t sent = local::offer_all(peers_.front(), frames, fd_, t_ns);
    counters_.sent += sent;
    for (const Frame& frame : frames.first(sent)) {
      if (own_echo_ && wants(frame)) ready_.push(frame, t_ns, true, Wake::yes);
    }
    return sent;
  }

  /// If a frame is waiting, receive() needs one system call. The search for new nodes needs another one.
  /// Therefore receive() looks for new nodes only if two successive searches have found no frame, or after
  /// accept_every reads. No node is overlooked, because a new node wakes a host that waits.
  std::optional<Received> receive() override {
    if (wire_) run_wire();
    if (!ready_.empty()) return next_ready();  // these frames are older than all frames in the sockets
    if (wire_ || std::exchange(took_all_, false)) return std::nullopt;
    std::optional<Received> received(std::in_place);
    Datagram datagram;
    int let_in = 0;
    for (int n = 0; n < most_at_once && catch_up(); ++n) {
      if (++reads_since_accept_ >= accept_every) accept_nodes();
      if (one_node() && read_together()) {
        found_nothing_ = false;
        if (!ready_.empty()) return next_ready();
        continue;
      }
      const int origin = one_node() ? no_origin : read_any(datagram, received->frame);
      if (origin == no_origin) {
        if (!std::exchange(found_nothing_, true) || ++let_in > most_let_in || !accept_nodes()) break;
        continue;
      }
      found_nothing_ = false;
      datagram.t_ns = clock_ns(CLOCK_MONOTONIC);
      deliver(datagram, origin);
      if (!wants(received->frame)) continue;
      received->t_ns = datagram.t_ns;
      received->source = StampSource::hub;
      count(*received);
      return received;
    }
    return std::nullopt;
  }

  [[nodiscard]] int descriptor() const override { return events_.descriptor(); }
  /// An epoll descriptor is never writable. If the bus is stalled, the descriptor becomes readable when the
  /// node that stalls the bus has room.
  [[nodiscard]] RoomWait room_wait() const override {
    if (behind_ > 0) return {.events = POLLIN};
    if (wire_) return {.pause_ns = wire_->frame_ns()};
    return {.pause_ns = ready_.size() >= ready_limit ? 1'000'000 : 0};
  }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return counters_; }
  [[nodiscard]] Capabilities capabilities() const override {
    return wire_ ? Capabilities{.reports_errors = true, .wire = wire_->facts()} : Capabilities{};
  }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] std::vector<std::string> nodes() const override { return local::names(peers_); }
  [[nodiscard]] std::string held_up_by() const override { return local::first_behind(peers_); }

 private:
  static constexpr int no_origin = -1;

  /// Sets which events wake the host. While the bus is stalled, only the nodes that stall the bus may wake
  /// the host, because the bus carries no other frames.
  void watch_all() {
    const std::uint32_t others = behind_ > 0 ? 0 : std::uint32_t{EPOLLIN};
    events_.watch(gate_.listener(), others);
    for (const Peer& peer : peers_)
      events_.watch(peer.socket.get(), peer.behind ? std::uint32_t{EPOLLOUT} : peer.held ? 0 : others);
    gate_.set_alarm(peers_);
  }

  /// Delivers the pending frame to the nodes that had no room for it, and drops nodes that have stalled the
  /// bus for too long. True if no frame is pending now.
  bool catch_up() {
    if (behind_ == 0) return true;
    const int before = behind_;
    const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
    std::erase_if(peers_, [&](Peer& peer) {
      if (!peer.behind) return false;
      const bool delivered = local::offer(peer, pending_, peer.socket.get() == pending_origin_);
      if (!delivered && !gate_.has_waited_enough(peer, now_ns)) return false;
      --behind_;
      peer.behind = false;
      peer.arrears_ns += now_ns - peer.behind_since_ns;
      if (!delivered) gate_.report_dropped_reader(peer);
      return !delivered;
    });
    if (behind_ != before) watch_all();
    return behind_ == 0;
  }

  /// Delivers a frame to every node that wants it. If a node has no room, the frame remains pending. The next
  /// frame is read only after all these nodes have received the pending one.
  void deliver(Datagram& datagram, int origin) {
    for (Peer& peer : peers_) deliver_to(peer, datagram, origin);
    if (behind_ > 0) watch_all();
  }

  void deliver_to(Peer& peer, Datagram& datagram, int origin) {
    if (local::offer(peer, datagram, peer.socket.get() == origin)) return;
    peer.behind = true;
    peer.behind_since_ns = clock_ns(CLOCK_MONOTONIC);
    ++behind_;
    pending_ = datagram;
    pending_origin_ = origin;
  }

  /// Reads the next frame; the nodes take turns. Returns the socket of the node that sent the frame;
  /// no_origin: no node has sent a frame.
  int read_any(Datagram& datagram, Frame& frame) {
    for (std::size_t idle = 0; idle < peers_.size();) {
      if (next_ >= peers_.size()) next_ = 0;
      Peer& peer = peers_[next_];
      switch (peer.held ? Reading::nothing : local::read(peer, fd_, datagram, frame)) {
        case Reading::nothing:
          ++next_;
          ++idle;
          break;
        case Reading::joined:
          gate_.set_alarm(peers_);
          gate_.count(peers_);
          break;
        case Reading::frame:
          ++next_;
          return peer.socket.get();
        case Reading::nonsense:
          gate_.report_nonsense(peer);
          [[fallthrough]];
        case Reading::gone:
          peers_.erase(peers_.begin() + static_cast<std::ptrdiff_t>(next_));
          gate_.count(peers_);
          break;
      }
    }
    return no_origin;
  }

  /// Whether the bus has one other node, to which the hub delivers none of the frames that it reads.
  [[nodiscard]] bool one_node() const {
    return peers_.size() == 1 && peers_.front().joined && !peers_.front().own_echo;
  }

  /// Reads the frames of the only node, many in one system call, into ready_. False: the node has sent
  /// nothing.
  bool read_together() {
    const Reading end = local::read_all(peers_.front(), batch_, fd_, [this](const Frame& frame) {
      if (wants(frame)) ready_.push(frame, clock_ns(CLOCK_MONOTONIC), false, Wake::no);
    });
    if (end == Reading::nothing) return false;
    took_all_ = batch_.took_all();
    if (end == Reading::nonsense) gate_.report_nonsense(peers_.front());
    if (end != Reading::frame) {
      peers_.clear();
      gate_.count(peers_);
    }
    return true;
  }

  /// Admits or refuses the next waiting node; false: no node was waiting.
  bool accept_nodes() {
    reads_since_accept_ = 0;
    gate_.drop_silent(peers_, fd_);
    const Gate::Admission admission = gate_.admit(peers_);
    if (admission == Gate::Admission::admitted) {
      events_.watch(peers_.back().socket.get(), EPOLLIN);
      if (wire_) peers_.back().wire_node = wire_->add_node();
    }
    return admission != Gate::Admission::none;
  }

  [[nodiscard]] bool wants(const Frame& frame) const {
    return !only_some_ || frame.error || (!frame.extended && wanted_.test(frame.id));
  }

  Received next_ready() {
    const Received received = ready_.pop();
    count(received);
    return received;
  }

  SendOutcome send_over_wire(const Frame& frame) {
    run_wire();
    if (behind_ > 0 || ready_.size() >= ready_limit || !wire_->queue(HubWire::host, frame))
      return SendOutcome::queue_full;
    wire_->set_alarm();
    ++counters_.sent;
    return SendOutcome::sent;
  }

  /// Moves frames from the nodes into the queues of the wire, and delivers the frames whose transmission on
  /// the wire has ended by now.
  void run_wire() {
    int left = most_at_once;
    while (catch_up()) {
      if (const auto report = wire_->report()) {
        deliver(*report);
        continue;
      }
      take_in(left);
      if (behind_ > 0) continue;
      if (const auto carried = wire_->next()) {
        arrive(*carried);
      } else if (!wire_->has_report()) {
        return wire_->set_alarm();
      }
    }
    wire_->stop_alarm();  // the bus is stalled
  }

  [[nodiscard]] std::vector<Peer>::iterator peer_of(std::size_t wire_node) {
    return std::ranges::find_if(peers_, [wire_node](const Peer& peer) {
      return peer.wire_node == wire_node && wire_node != HubWire::host;
    });
  }

  /// Delivers the report of a controller only to the node that has this controller.
  void deliver(const WireReport& report) {
    if (report.node == HubWire::host) return ready_.push(report.frame, report.t_ns, false, Wake::yes);
    const auto peer = peer_of(report.node);
    if (peer == peers_.end()) return;
    Datagram datagram;
    local::encode(report.frame, datagram);
    datagram.t_ns = report.t_ns;
    deliver_to(*peer, datagram, no_origin);
    if (behind_ > 0) watch_all();
  }

  void arrive(const Carried& carried) {
    const auto from = peer_of(carried.node);
    Datagram datagram;
    local::encode(carried.frame, datagram);
    datagram.t_ns = carried.delivered_ns;
    deliver(datagram, from == peers_.end() ? no_origin : from->socket.get());
    const bool own = carried.node == HubWire::host;
    if ((!own || own_echo_) && wants(carried.frame))
      ready_.push(carried.frame, carried.delivered_ns, own, Wake::yes);
  }

  /// Moves at most `left` frames from the nodes into the queues of the wire. Does not read from nodes whose
  /// queue is full, and stops early if too many frames wait for the host.
  void take_in(int& left) {
    for (int n = 0; n < most_let_in && accept_nodes(); ++n) {
    }
    Datagram datagram;
    Frame frame;
    while (behind_ == 0 && ready_.size() < ready_limit && left-- > 0) {
      hold_full_nodes();
      const int origin = read_any(datagram, frame);
      if (origin == no_origin) return;
      if (frame.error) {  // an error frame that a node sent is not transmitted over the wire
        datagram.t_ns = clock_ns(CLOCK_MONOTONIC);
        deliver(datagram, origin);
        if (wants(frame)) ready_.push(frame, datagram.t_ns, false, Wake::yes);
        continue;
      }
      const auto from = std::ranges::find(peers_, origin, [](const Peer& peer) { return peer.socket.get(); });
      wire_->queue(from->wire_node, frame);
    }
  }

  void hold_full_nodes() {
    for (Peer& peer : peers_) {
      const bool full = !wire_->has_room(peer.wire_node);
      if (full == std::exchange(peer.held, full)) continue;
      events_.watch(peer.socket.get(), full ? 0 : std::uint32_t{EPOLLIN});
    }
  }

  void count(const Received& received) {
    ++counters_.received;
    if (received.frame.error) ++counters_.error_frames;
  }

  local::Claim claim_;
  Gate gate_;
  Watched events_;
  std::string name_;
  bool fd_;
  bool only_some_;
  local::IdSet wanted_;
  bool own_echo_;
  std::optional<HubWire> wire_;  ///< nullopt: frames take no time
  std::vector<Peer> peers_;
  std::size_t next_ = 0;
  int reads_since_accept_ = 0;
  bool found_nothing_ = false;
  int behind_ = 0;  ///< number of peers for which Peer::behind is true
  Datagram pending_{};
  int pending_origin_ = no_origin;
  local::ReadyQueue ready_;
  local::DatagramBatch batch_{local::DatagramBatch::Messages::of_one};  ///< from the only node
  bool took_all_ = false;  ///< the only node had sent nothing more; wait() notices what it sends later
  PortCounters counters_;
};

}  // namespace

Result<std::unique_ptr<LocalHub>> host_local_bus(std::string_view bus, const PortOptions& options,
                                                 HubRules rules) {
  const auto name = local::bus_name(bus);
  if (!name) return tl::unexpected(name.error());
  const auto wanted = local::id_set(options.only_ids);
  if (!wanted) return tl::unexpected(wanted.error());

  auto claim = local::Claim::take(bus, name->name);
  if (!claim) return tl::unexpected(claim.error());
  Descriptor listener = claim->listen(options.fd ? Format::fd : Format::classic, backlog);
  if (!listener) return failure(fmt::format("bus '{}': {}", bus, std::strerror(errno)));
  std::optional<HubWire> wire;
  if (name->wire.rates.nominal > 0) wire.emplace(name->wire);
  Gate gate(std::move(listener), std::move(rules), std::string(bus));
  return std::make_unique<Hub>(std::move(*claim), std::move(gate), std::string(bus), options, *wanted,
                               std::move(wire));
}

}  // namespace canhil
