// The hub of the embedded bus: the host's port.
#include <fmt/format.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <deque>
#include <utility>

#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/frame_rules.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/ports/local_wire.hpp"

namespace canhil {
namespace {

using local::Datagram;
using local::Place;

constexpr int backlog = 64;               // nodes that wait to be accepted
constexpr std::size_t echo_limit = 4096;  // own frames that the host has not read back
constexpr int accept_every = 64;          // frames in a row after which new nodes get their turn

struct Peer {
  Descriptor socket;
  std::string name;
  bool joined = false;  ///< has said Hello
  bool own_echo = false;
  bool only_some = false;
  bool mute = false;    ///< takes no more frames; what it sent before still counts
  bool behind = false;  ///< pending_ is still to be delivered
  local::IdSet wanted;
};

enum class Reading : std::uint8_t { nothing, joined, frame, gone };

class Hub final : public LocalHub {
 public:
  Hub(Descriptor claim, Descriptor listener, std::string name, const PortOptions& options,
      local::IdSet wanted)
      : claim_(std::move(claim)),
        listener_(std::move(listener)),
        epoll_(::epoll_create1(EPOLL_CLOEXEC)),
        name_(std::move(name)),
        fd_(options.fd),
        only_some_(!options.only_ids.empty()),
        wanted_(wanted) {
    if (options.own_echo) {
      echo_event_ = Descriptor(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
      watch(echo_event_, EPOLLIN);
    }
    watch(listener_, EPOLLIN);
  }

  SendOutcome send(const Frame& frame) override {
    if (!can_carry(frame, fd_)) return SendOutcome::refused;
    if (!catch_up() || echoes_.size() >= echo_limit) return SendOutcome::queue_full;
    Datagram datagram;
    local::encode(frame, datagram);
    datagram.t_ns = clock_ns(CLOCK_MONOTONIC);
    deliver(datagram, no_origin);
    if (echo_event_ && wants(frame)) queue_echo(frame, datagram.t_ns);
    ++counters_.sent;
    return SendOutcome::sent;
  }

  /// Costs one system call where a frame waits. For new nodes it looks where it finds nothing twice in a row:
  /// a host that waits in between is woken by them, and one that is only between two frames need not pay for
  /// the look.
  std::optional<Received> receive() override {
    if (!echoes_.empty()) return next_echo();  // older than anything still to be read
    std::optional<Received> received(std::in_place);
    Datagram datagram;
    while (catch_up()) {
      if (++reads_since_accept_ >= accept_every) accept_nodes();
      const int origin = read_any(datagram, received->frame);
      if (origin == no_origin) {
        if (!std::exchange(found_nothing_, true) || !accept_nodes()) break;
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
    received.reset();
    return received;
  }

  [[nodiscard]] int descriptor() const override { return epoll_.get(); }
  /// An epoll descriptor is never writable: while the bus stands still it turns readable once the slow node
  /// has room.
  [[nodiscard]] RoomWait room_wait() const override {
    if (behind_ > 0) return {.events = POLLIN};
    return {.pause_ns = echoes_.size() >= echo_limit ? 1'000'000 : 0};
  }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return counters_; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] std::vector<std::string> nodes() const override {
    std::vector<std::string> names;
    for (const Peer& peer : peers_) {
      if (peer.joined) names.push_back(peer.name);
    }
    return names;
  }
  [[nodiscard]] std::string held_up_by() const override {
    const auto slow = std::ranges::find(peers_, true, &Peer::behind);
    return slow == peers_.end() ? std::string() : slow->name;
  }

 private:
  static constexpr int no_origin = -1;

  void watch(const Descriptor& descriptor, std::uint32_t events) {
    epoll_event event{.events = events, .data = {.fd = descriptor.get()}};
    if (events == 0) {
      ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, descriptor.get(), nullptr);
    } else if (::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, descriptor.get(), &event) != 0) {
      ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, descriptor.get(), &event);
    }
  }

  /// While the bus stands still only the nodes it waits for may wake the host: nobody else's frames can pass.
  void watch_all() {
    const std::uint32_t others = behind_ > 0 ? 0 : std::uint32_t{EPOLLIN};
    watch(listener_, others);
    for (const Peer& peer : peers_) watch(peer.socket, peer.behind ? std::uint32_t{EPOLLOUT} : others);
  }

  /// Delivers the pending frame to the nodes that had no room for it; true if none is left.
  bool catch_up() {
    if (behind_ == 0) return true;
    const int before = behind_;
    for (Peer& peer : peers_) {
      if (peer.behind && offer(peer, pending_, pending_origin_)) {
        peer.behind = false;
        --behind_;
      }
    }
    if (behind_ != before) watch_all();
    return behind_ == 0;
  }

  /// Gives one frame to every node that wants it. Only one frame can be pending: the next is taken when none
  /// is.
  void deliver(Datagram& datagram, int origin) {
    for (Peer& peer : peers_) {
      if (offer(peer, datagram, origin)) continue;
      peer.behind = true;
      ++behind_;
    }
    if (behind_ == 0) return;
    pending_ = datagram;
    pending_origin_ = origin;
    watch_all();
  }

  /// False: the node wants the frame and has no room for it.
  static bool offer(Peer& peer, Datagram& datagram, int origin) {
    const bool own = peer.socket.get() == origin;
    if (!peer.joined || peer.mute || (own && !peer.own_echo)) return true;
    const bool selectable = (datagram.flags & (Datagram::error | Datagram::extended)) == 0;
    const bool error = (datagram.flags & Datagram::error) != 0;
    if (peer.only_some && !error && !(selectable && peer.wanted.test(datagram.id))) return true;
    const auto flags = static_cast<std::uint8_t>(datagram.flags & ~Datagram::own);
    datagram.flags = static_cast<std::uint8_t>(flags | (own ? Datagram::own : 0));
    if (::send(peer.socket.get(), &datagram, datagram.bytes(), MSG_NOSIGNAL) >= 0) return true;
    if (errno == EAGAIN || errno == ENOBUFS || errno == EINTR) return false;
    peer.mute = true;  // dead; reading from it will end with that
    return true;
  }

  /// The next frame of any node, in turn, and whose it is.
  int read_any(Datagram& datagram, Frame& frame) {
    for (std::size_t idle = 0; idle < peers_.size();) {
      if (next_ >= peers_.size()) next_ = 0;
      Peer& peer = peers_[next_];
      switch (read(peer, datagram, frame)) {
        case Reading::nothing:
          ++next_;
          ++idle;
          break;
        case Reading::joined:
          break;
        case Reading::frame:
          ++next_;
          return peer.socket.get();
        case Reading::gone:
          peers_.erase(peers_.begin() + static_cast<std::ptrdiff_t>(next_));
          break;
      }
    }
    return no_origin;
  }

  Reading read(Peer& peer, Datagram& datagram, Frame& frame) const {
    if (!peer.joined) return read_hello(peer);
    ssize_t bytes = 0;
    do {
      bytes = ::recv(peer.socket.get(), &datagram, sizeof datagram, MSG_TRUNC);
    } while (bytes < 0 && (errno == EINTR || errno == ECONNRESET));
    if (bytes < 0 && errno == EAGAIN) return Reading::nothing;
    if (bytes <= 0) return Reading::gone;
    const bool one_of_ours = local::decode(datagram, static_cast<std::size_t>(bytes), fd_, frame);
    return one_of_ours ? Reading::frame : Reading::gone;
  }

  static Reading read_hello(Peer& peer) {
    local::Hello hello;
    const ssize_t bytes = ::recv(peer.socket.get(), &hello, sizeof hello, MSG_TRUNC);
    if (bytes < 0 && (errno == EAGAIN || errno == EINTR)) return Reading::nothing;
    if (bytes != sizeof hello || hello.magic != local::Hello::expected_magic) return Reading::gone;
    hello.node_name.back() = '\0';
    peer.name = hello.node_name.data();
    peer.own_echo = hello.own_echo != 0;
    peer.only_some = hello.only_some != 0;
    for (std::size_t id = 0; id < peer.wanted.size(); ++id)
      peer.wanted[id] = (hello.wanted[id / 8] >> (id % 8) & 1) != 0;
    peer.joined = true;
    return Reading::joined;
  }

  /// Lets waiting nodes in; true if there were any.
  bool accept_nodes() {
    reads_since_accept_ = 0;
    pollfd waiting{.fd = listener_.get(), .events = POLLIN, .revents = 0};
    if (::poll(&waiting, 1, 0) != 1) return false;  // far cheaper than an accept() in vain
    Descriptor socket(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!socket) return false;
    watch(socket, EPOLLIN);
    peers_.emplace_back().socket = std::move(socket);
    return true;
  }

  [[nodiscard]] bool wants(const Frame& frame) const {
    return !only_some_ || frame.error || (!frame.extended && wanted_.test(frame.id));
  }

  void queue_echo(const Frame& frame, std::int64_t t_ns) {
    if (echoes_.empty()) ::eventfd_write(echo_event_.get(), 1);
    echoes_.push_back({.frame = frame, .t_ns = t_ns, .source = StampSource::hub, .own = true});
  }

  Received next_echo() {
    const Received echo = echoes_.front();
    echoes_.pop_front();
    eventfd_t events = 0;
    if (echoes_.empty()) ::eventfd_read(echo_event_.get(), &events);
    count(echo);
    return echo;
  }

  void count(const Received& received) {
    ++counters_.received;
    if (received.frame.error) ++counters_.error_frames;
  }

  Descriptor claim_;
  Descriptor listener_;
  Descriptor epoll_;
  Descriptor echo_event_;
  std::string name_;
  bool fd_;
  bool only_some_;
  local::IdSet wanted_;
  std::vector<Peer> peers_;
  std::size_t next_ = 0;
  int reads_since_accept_ = 0;
  bool found_nothing_ = false;
  int behind_ = 0;  ///< how many peers are
  Datagram pending_{};
  int pending_origin_ = no_origin;
  std::deque<Received> echoes_;
  PortCounters counters_;
};

Descriptor bound(const std::string& name, Place place) {
  Descriptor socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const local::Address at = local::address(name, place);
  if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&at.socket), at.length) != 0) return {};
  return socket;
}

}  // namespace

Result<std::unique_ptr<LocalHub>> host_local_bus(std::string_view bus, const PortOptions& options) {
  const auto name = local::bus_name(bus);
  if (!name) return tl::unexpected(name.error());
  const auto wanted = local::id_set(options.only_ids);
  if (!wanted) return tl::unexpected(wanted.error());

  Descriptor claim = bound(*name, Place::claim);
  if (!claim && errno == EADDRINUSE) {
    return failure(
        fmt::format("bus '{}' is hosted already by another process: join it or take another name", bus));
  }
  Descriptor listener = claim ? bound(*name, options.fd ? Place::fd : Place::classic) : Descriptor();
  if (!listener || ::listen(listener.get(), backlog) != 0) {
    return failure(fmt::format("bus '{}': {}", bus, std::strerror(errno)));
  }
  return std::make_unique<Hub>(std::move(claim), std::move(listener), std::string(bus), options, *wanted);
}

void run_hub(Port& hub, const std::function<bool()>& stop) {
  constexpr std::int64_t look_up_ns = 100'000'000;
  constexpr int at_most = 1000;  // frames in a row: a full bus must not hide stop()
  while (!stop()) {
    wait(hub, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + look_up_ns);
    for (int n = 0; n < at_most && hub.receive(); ++n) {
    }
  }
}

}  // namespace canhil
