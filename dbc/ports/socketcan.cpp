#include "dbc/ports/socketcan.hpp"

#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/net_tstamp.h>
#include <linux/sock_diag.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "dbc/ports/ancillary.hpp"
#include "dbc/ports/can_interface.hpp"
#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/receive_batch.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil {
namespace {

constexpr std::int64_t retry_ns = 200'000;  // the duration of about 1.5 full classic frames at 1 Mbit/s
constexpr std::int64_t blocking_ns =
    20'000'000;  // the longest time for which one call waits for a frame (SO_RCVTIMEO)
constexpr std::int64_t look_again_ns =
    10'000'000;                             // the time between two checks whether an interface is up again
constexpr int large_queue_bytes = 4 << 20;  // room for about 5000 frames: half a second of a full bus

canfd_frame to_kernel(const Frame& frame) {
  canfd_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.error ? CAN_ERR_FLAG : 0U);
  raw.len = frame.size;
  if (frame.fd)
    raw.flags = static_cast<std::uint8_t>((frame.brs ? CANFD_BRS : 0) | (frame.esi ? CANFD_ESI : 0));
  std::memcpy(raw.data, frame.data.data(), frame.size);
  return raw;
}

Frame from_kernel(const canfd_frame& raw, bool fd) {
  Frame frame;
  frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
  frame.extended = !frame.error && (raw.can_id & CAN_EFF_FLAG) != 0;
  frame.id = raw.can_id & (frame.error || frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.size = std::min<std::uint8_t>(raw.len, fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN);
  frame.fd = fd;
  frame.brs = fd && (raw.flags & CANFD_BRS) != 0;
  frame.esi = fd && (raw.flags & CANFD_ESI) != 0;
  std::memcpy(frame.data.data(), raw.data, frame.size);
  return frame;
}

template <class T>
bool set(int socket, int level, int option, const T& value) {
  return ::setsockopt(socket, level, option, &value, sizeof value) == 0;
}

/// Sets the filters of the socket: it receives frames with the given ids, or all frames if no ids are given.
/// Remote frames are never received.
bool set_filters(int socket, const std::vector<std::uint32_t>& only_ids) {
  std::vector<can_filter> filters;
  filters.reserve(only_ids.size() + 1);
  for (const std::uint32_t id : only_ids) {
    filters.push_back({.can_id = id, .can_mask = CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  if (filters.empty()) filters.push_back({.can_id = 0, .can_mask = CAN_RTR_FLAG});
  const can_err_mask_t all_errors = CAN_ERR_MASK;
  return ::setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                      static_cast<socklen_t>(filters.size() * sizeof(can_filter))) == 0 &&
         set(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, all_errors);
}

bool configure(int socket, const PortOptions& options) {
  const int stamps = SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE | SOF_TIMESTAMPING_RX_HARDWARE |
                     SOF_TIMESTAMPING_RAW_HARDWARE;
  const int on = 1;
  const int own = options.own_echo ? 1 : 0;
  const timeval blocking{.tv_sec = 0, .tv_usec = blocking_ns / 1000};
  const int smallest = 0;  // the kernel uses its minimum instead; for the reason see socketcan.hpp
  const int receive_bytes =
      options.receive_buffer_bytes == 0 ? large_queue_bytes : options.receive_buffer_bytes;
  return set_filters(socket, options.only_ids) && set(socket, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, own) &&
         set(socket, SOL_SOCKET, SO_TIMESTAMPING, stamps) && set(socket, SOL_SOCKET, SO_RCVTIMEO, blocking) &&
         set(socket, SOL_SOCKET, SO_SNDBUF, smallest) &&
         ((!options.fd && !options.foreign) || set(socket, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, on)) &&
         // SO_RCVBUFFORCE needs CAP_NET_ADMIN; SO_RCVBUF cannot exceed net.core.rmem_max.
         (set(socket, SOL_SOCKET, SO_RCVBUFFORCE, receive_bytes) ||
          set(socket, SOL_SOCKET, SO_RCVBUF, receive_bytes));
}

class SocketCan final : public Port {
 public:
  SocketCan(Descriptor socket, std::string name, PortOptions options)
      : socket_(std::move(socket)), name_(std::move(name)), options_(std::move(options)) {}

  /// Binds the socket to the interface that has the name at present. If the socket is bound to this interface
  /// already, the kernel does nothing. Also sets the filters, because the socket loses them when its
  /// interface is removed. False: errno has the reason.
  bool bind_to_interface() {
    sockaddr_can at{};
    at.can_family = AF_CAN;
    at.can_ifindex = interface_index(name_);
    return at.can_ifindex != 0 && set_filters(socket_.get(), options_.only_ids) &&
           ::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0;
  }

  SendOutcome send(const Frame& frame) override {
    if (!can_carry(frame, options_.fd)) return SendOutcome::refused;
    if (!up_ && !is_back()) return SendOutcome::down;
    const canfd_frame raw = to_kernel(frame);
    interface_queue_full_ = false;
    if (::send(socket_.get(), &raw, frame.fd ? CANFD_MTU : CAN_MTU, MSG_DONTWAIT) >= 0) {
      ++counters_.sent;
      return SendOutcome::sent;
    }
    return send_failure(errno);
  }

  std::optional<Received> receive() override {
    if (batch_.empty() && !fetch()) return std::nullopt;
    const ReceiveBatch::Item item = batch_.take();
    Received received{.frame = from_kernel(item.frame, item.fd), .own = item.own};
    stamp(received, item.ancillary);
    ++counters_.received;
    if (received.frame.error) ++counters_.error_frames;
    received.foreign = received.frame.fd && !options_.fd;
    if (received.foreign) ++counters_.foreign;
    return received;
  }

  /// Waits and reads in one system call, which shortens the latency of the frame. The timeout of this call is
  /// coarse. Therefore the last milliseconds before the deadline are spent in poll(), which has an exact
  /// timer.
  bool wait_for_frame(std::int64_t deadline_ns) override {
    if (!batch_.empty()) return true;
    while (deadline_ns == no_deadline || deadline_ns - clock_ns(CLOCK_MONOTONIC) >= 2 * blocking_ns) {
      if (fetch(MSG_WAITFORONE)) return true;
      if (errno != EAGAIN) return errno != EINTR;  // if the interface is down, receive() finds out
    }
    return Port::wait_for_frame(deadline_ns);
  }

  [[nodiscard]] int descriptor() const override { return socket_.get(); }
  [[nodiscard]] RoomWait room_wait() const override {
    return interface_queue_full_ ? RoomWait{.pause_ns = retry_ns} : RoomWait{.events = POLLOUT};
  }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] bool up() const override { return up_; }
  /// Reads the number of lost frames with SO_MEMINFO, because SO_RXQ_OVFL would report a loss only with the
  /// next frame in the queue.
  [[nodiscard]] PortCounters counters() const override {
    PortCounters counters = counters_;
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    socklen_t size = sizeof memory;
    if (::getsockopt(socket_.get(), SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0)
      counters.overflowed = memory[SK_MEMINFO_DROPS];
    return counters;
  }
  [[nodiscard]] Capabilities capabilities() const override { return {.reports_errors = true}; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_REALTIME; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  /// Reads the waiting frames. False: no frame is waiting, or the previous read emptied the queue.
  bool fetch() {
    if (!up_) is_back();
    if (took_all_) {  // saves a system call; wait() notices frames that have come since then
      took_all_ = false;
      return false;
    }
    return fetch(MSG_DONTWAIT);
  }

  bool fetch(int flags) {
    const bool any = batch_.fetch(socket_.get(), flags);
    const int error = errno;
    if (!any) note_outage(error);
    errno = error;
    took_all_ = any && batch_.took_all();
    return any;
  }

  SendOutcome send_failure(int error) {
    switch (error) {
      case ENOBUFS:
        interface_queue_full_ = true;
        return SendOutcome::queue_full;
      case EAGAIN:
      case EINTR:
        return SendOutcome::queue_full;
      case EINVAL:
      case EMSGSIZE:
        return SendOutcome::refused;
      default:
        note_outage(error);
        return SendOutcome::down;
    }
  }

  void note_outage(int error) {
    if (error != ENETDOWN && error != ENODEV && error != ENXIO) return;
    up_ = false;
    clear_error();
  }

  /// Clears a pending error of the socket, so that the error does not wake the receiver again.
  void clear_error() {
    int pending = 0;
    socklen_t size = sizeof pending;
    ::getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &pending, &size);
  }

  /// Returns whether the interface is up again; it may have been removed and created again. Asks the kernel
  /// at most once in look_again_ns.
  bool is_back() {
    const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
    if (now_ns < look_ns_) return false;
    look_ns_ = now_ns + look_again_ns;
    clear_error();
    up_ = !objection(socket_.get(), name_, options_.fd) && bind_to_interface();
    return up_;
  }

  static void stamp(Received& received, const Ancillary& said) {
    received.t_ns = said.software_ns;
    received.hardware_ns = said.hardware_ns;
    received.source = said.hardware_ns != 0 ? StampSource::hardware : StampSource::kernel;
    if (said.software_ns == 0) {  // only the first frames, because the kernel enables stamps with a delay
      received.t_ns = clock_ns(CLOCK_REALTIME);
      if (said.hardware_ns == 0) received.source = StampSource::process;
    }
  }

  Descriptor socket_;
  std::string name_;
  PortOptions options_;
  bool up_ = true;
  std::int64_t look_ns_ = 0;  // when to check next whether the interface is up again
  bool interface_queue_full_ = false;
  ReceiveBatch batch_;
  bool took_all_ = false;  // the queue was empty after the last frame that receive() returned
  PortCounters counters_;
};

std::string no_socket(std::string_view interface, int error) {
  switch (error) {
    case EAFNOSUPPORT:
      return fmt::format(
          "cannot open '{}': this kernel has no CAN (AF_CAN); load the module can, or use local:NAME",
          interface);
    case EPROTONOSUPPORT:
      return fmt::format("cannot open '{}': this kernel has no raw CAN sockets; `modprobe can-raw`",
                         interface);
    default:
      return fmt::format("cannot open '{}': {}", interface, std::strerror(error));
  }
}

}  // namespace

Result<std::unique_ptr<Port>> open_socketcan(std::string_view interface, const PortOptions& options) {
  const auto wide =
      std::ranges::find_if(options.only_ids, [](std::uint32_t id) { return id > max_standard_id; });
  if (wide != options.only_ids.end()) {
    return failure(fmt::format("only_ids: 0x{:X} is not a standard id (0 to 0x7FF)", *wide));
  }
  Descriptor socket(::socket(AF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
  if (!socket) return failure(no_socket(interface, errno));
  if (auto why = objection(socket.get(), interface, options.fd)) return failure(std::move(*why));

  const bool configured = configure(socket.get(), options);
  auto port = std::make_unique<SocketCan>(std::move(socket), std::string(interface), options);
  if (!configured || !port->bind_to_interface())
    return failure(fmt::format("cannot open '{}': {}", interface, std::strerror(errno)));
  return port;
}

}  // namespace canhil
