// The port of a node of the embedded bus. The node has one connection to the hub.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "dbc/ports/datagram_batch.hpp"
#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/ports/local_place.hpp"
#include "dbc/ports/local_wire.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil {
namespace {

using local::Datagram;
using local::Format;

/// How long one system call waits for a frame.
constexpr std::int64_t blocking_ns = 20'000'000;

class LocalNode final : public Port {
 public:
  LocalNode(Descriptor socket, std::string name, bool fd, WireFacts wire)
      : socket_(std::move(socket)), name_(std::move(name)), fd_(fd), wire_(wire) {}

  SendOutcome send(const Frame& frame) override {
    if (!can_carry(frame, fd_)) return SendOutcome::refused;
    Datagram datagram;
    local::encode(frame, datagram);
    if (::send(socket_.get(), &datagram, datagram.bytes(), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0) {
      ++counters_.sent;
      return SendOutcome::sent;
    }
    return errno == EAGAIN || errno == ENOBUFS || errno == EINTR ? SendOutcome::queue_full
                                                                 : SendOutcome::down;
  }

  std::size_t send_all(std::span<const Frame> frames) override {
    if (frames.size() == 1) return Port::send_all(frames);
    const std::size_t sent = local::send_frames(socket_.get(), frames, fd_, 0);
    counters_.sent += sent;
    return sent;
  }

  std::optional<Received> receive() override {
    if (batch_.empty() && !fetch()) return std::nullopt;
    const auto [datagram, bytes] = batch_.take();
    std::optional<Received> received(std::in_place);
    if (!local::decode(datagram, bytes, fd_, received->frame)) {
      closed_ = true;  // the hub has ended, or the other process is no hub
      return std::nullopt;
    }
    received->t_ns = datagram.t_ns;
    received->source = StampSource::hub;
    received->own = (datagram.flags & Datagram::own) != 0;
    ++counters_.received;
    if (received->frame.error) ++counters_.error_frames;
    return received;
  }

  /// Waits and reads in one system call. Its timeout is coarse, therefore the last milliseconds before the
  /// deadline are spent in poll(), which has an exact timer.
  bool wait_for_frame(std::int64_t deadline_ns) override {
    while (deadline_ns == no_deadline || deadline_ns - clock_ns(CLOCK_MONOTONIC) >= 2 * blocking_ns) {
      if (!batch_.empty() || fetch(MSG_WAITFORONE)) return true;
      if (closed_ || errno != EAGAIN) return errno != EINTR;
    }
    return !batch_.empty() || Port::wait_for_frame(deadline_ns);
  }

  [[nodiscard]] int descriptor() const override { return socket_.get(); }
  [[nodiscard]] RoomWait room_wait() const override { return {.events = POLLOUT}; }
  [[nodiscard]] bool closed() const override { return closed_; }
  [[nodiscard]] PortCounters counters() const override { return counters_; }
  [[nodiscard]] Capabilities capabilities() const override {
    return {.reports_errors = wire_.rates.nominal > 0, .wire = wire_};
  }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  /// Reads the waiting frames. False: no frame is waiting, the previous read emptied the queue, or the hub
  /// has ended.
  bool fetch() {
    if (std::exchange(took_all_, false))
      return false;  // saves a system call; wait() notices what has come since
    return fetch(MSG_DONTWAIT);
  }

  bool fetch(int flags) {
    const bool any = batch_.fetch(socket_.get(), flags);
    took_all_ = any && batch_.took_all();
    if (!any && errno != EAGAIN && errno != EINTR) closed_ = true;
    return any;
  }

  Descriptor socket_;  // blocking, with the timeout blocking_ns
  std::string name_;
  bool fd_;
  WireFacts
      wire_;  // known only if the name of the bus has the settings, because the hub does not report them
  local::DatagramBatch batch_{local::DatagramBatch::Messages::together};
  bool took_all_ = false;  // the queue was empty after the last frame of the batch
  bool closed_ = false;
  PortCounters counters_;
};

std::string why_not_joined(std::string_view bus, const std::string& directory, const std::string& name,
                           bool fd, int error) {
  if (error == EAGAIN)
    return fmt::format("bus '{}': its host takes no more nodes (too many wait to join)", bus);
  if (error != ECONNREFUSED && error != ENOENT) return fmt::format("bus '{}': {}", bus, std::strerror(error));
  if (local::connect_to(directory, name, fd ? Format::classic : Format::fd)) {
    return fd ? fmt::format(
                    "bus '{}' is classic CAN and this node wants CAN FD: host it with FD, or join without",
                    bus)
              : fmt::format("bus '{}' carries CAN FD and this node is classic: join with FD", bus);
  }
  return fmt::format("{2}'{0}': nobody hosts it in {1}; start `hil-bench` first or `hil-bench bus {0}`", bus,
                     directory, nobody_hosts);
}

/// Makes reads without MSG_DONTWAIT wait for a frame, at most blocking_ns.
bool blocks(int socket) {
  const timeval most{.tv_sec = 0, .tv_usec = blocking_ns / 1000};
  const int flags = ::fcntl(socket, F_GETFL);
  return flags >= 0 && ::fcntl(socket, F_SETFL, flags & ~O_NONBLOCK) == 0 &&
         ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most) == 0;
}

}  // namespace

Result<std::unique_ptr<Port>> join_local_bus(std::string_view bus, const PortOptions& options) {
  const auto name = local::bus_name(bus);
  if (!name) return tl::unexpected(name.error());
  const auto wanted = local::id_set(options.only_ids);
  if (!wanted) return tl::unexpected(wanted.error());

  const auto directory = local::directory();
  if (!directory) return failure(fmt::format("bus '{}': {}", bus, directory.error().message));

  Descriptor socket = local::connect_to(*directory, name->name, options.fd ? Format::fd : Format::classic);
  if (!socket) return failure(why_not_joined(bus, *directory, name->name, options.fd, errno));
  if (const local::Process host = local::process_behind(socket.get()); !local::is_of_this_user(host)) {
    return failure(fmt::format("bus '{}': its host is {}, expected a process of uid {}", bus,
                               local::to_text(host), ::geteuid()));
  }

  local::Hello hello;
  hello.wishes =
      static_cast<std::uint8_t>(local::Hello::together | (options.own_echo ? local::Hello::own_echo : 0));
  hello.only_some = options.only_ids.empty() ? 0 : 1;
  for (std::size_t id = 0; id < wanted->size(); ++id) {
    if (wanted->test(id))
      hello.wanted[id / 8] = static_cast<std::uint8_t>(hello.wanted[id / 8] | 1U << (id % 8));
  }
  const std::size_t length = std::min(options.node_name.size(), hello.node_name.size() - 1);
  std::memcpy(hello.node_name.data(), options.node_name.data(), length);
  if (::send(socket.get(), &hello, sizeof hello, MSG_NOSIGNAL) < 0) {
    return failure(fmt::format("bus '{}': its host went away while this node joined", bus));
  }
  if (!blocks(socket.get())) return failure(fmt::format("bus '{}': {}", bus, std::strerror(errno)));
  return std::make_unique<LocalNode>(std::move(socket), std::string(bus), options.fd, name->wire.facts());
}

}  // namespace canhil
