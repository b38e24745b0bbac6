#include "dbc/ports/socketcan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/errqueue.h>
#include <linux/net_tstamp.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/frame_rules.hpp"

namespace canhil {
namespace {

constexpr std::int64_t retry_ns = 200'000;  // about 1.5 full classic frames at 1 Mbit/s

canfd_frame to_kernel(const Frame& frame) {
  canfd_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.error ? CAN_ERR_FLAG : 0U);
  raw.len = frame.size;
  raw.flags = frame.brs ? CANFD_BRS : 0;
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
  std::memcpy(frame.data.data(), raw.data, frame.size);
  return frame;
}

std::int64_t to_ns(const timespec& t) { return t.tv_sec * 1'000'000'000LL + t.tv_nsec; }

class SocketCan final : public Port {
 public:
  SocketCan(Descriptor socket, std::string name, bool fd)
      : socket_(std::move(socket)), name_(std::move(name)), fd_(fd) {}

  SendOutcome send(const Frame& frame) override {
    if (!can_carry(frame, fd_)) return SendOutcome::refused;
    const canfd_frame raw = to_kernel(frame);
    interface_queue_full_ = false;
    if (::write(socket_.get(), &raw, frame.fd ? CANFD_MTU : CAN_MTU) >= 0) {
      ++counters_.sent;
      return SendOutcome::sent;
    }
    return send_failure(errno);
  }

  std::optional<Received> receive() override {
    canfd_frame raw{};
    iovec part{.iov_base = &raw, .iov_len = sizeof raw};
    alignas(cmsghdr) std::array<char, 256> control;
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    const ssize_t bytes = ::recvmsg(socket_.get(), &message, 0);
    if (bytes < 0) {
      if (errno == ENODEV || errno == ENXIO) closed_ = true;  // ENETDOWN: it may come up again
      return std::nullopt;
    }
    if (bytes != CAN_MTU && bytes != CANFD_MTU) return std::nullopt;
    Received received{.frame = from_kernel(raw, bytes == CANFD_MTU),
                      .own = (message.msg_flags & MSG_CONFIRM) != 0};
    read_control(message, received);
    ++counters_.received;
    if (received.frame.error) ++counters_.error_frames;
    return received;
  }

  [[nodiscard]] int descriptor() const override { return socket_.get(); }
  [[nodiscard]] RoomWait room_wait() const override {
    return interface_queue_full_ ? RoomWait{.pause_ns = retry_ns} : RoomWait{.events = POLLOUT};
  }
  [[nodiscard]] bool closed() const override { return closed_; }
  [[nodiscard]] PortCounters counters() const override { return counters_; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_REALTIME; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
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
      case ENODEV:
      case ENXIO:
        closed_ = true;
        return SendOutcome::down;
      default:
        return SendOutcome::down;
    }
  }

  void read_control(msghdr& message, Received& received) {
    for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
      if (part->cmsg_level != SOL_SOCKET) continue;
      if (part->cmsg_type == SO_TIMESTAMPING) {
        scm_timestamping stamps{};  // [0] software, [2] raw hardware
        std::memcpy(&stamps, CMSG_DATA(part), sizeof stamps);
        received.t_ns = to_ns(stamps.ts[0]);
        received.hardware_ns = to_ns(stamps.ts[2]);
      } else if (part->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t lost = 0;  // since the socket was opened, modulo 2^32
        std::memcpy(&lost, CMSG_DATA(part), sizeof lost);
        counters_.overflowed += lost - static_cast<std::uint32_t>(counters_.overflowed);
      }
    }
    received.source = received.hardware_ns != 0 ? StampSource::hardware : StampSource::kernel;
    if (received.t_ns == 0) {  // the kernel turns stamping on a moment after it was asked for
      received.t_ns = clock_ns(CLOCK_REALTIME);
      received.source = StampSource::process;
    }
  }

  Descriptor socket_;
  std::string name_;
  bool fd_;
  bool closed_ = false;
  bool interface_queue_full_ = false;
  PortCounters counters_;
};

ifreq request_for(std::string_view interface) {
  ifreq request{};
  std::memcpy(request.ifr_name, interface.data(), std::min<std::size_t>(interface.size(), IFNAMSIZ - 1));
  return request;
}

bool is_can(int socket, std::string_view interface) {
  ifreq request = request_for(interface);
  return ::ioctl(socket, SIOCGIFHWADDR, &request) == 0 && request.ifr_hwaddr.sa_family == ARPHRD_CAN;
}

std::string can_interfaces(int socket) {
  std::vector<std::string> names;
  struct if_nameindex* all = ::if_nameindex();
  for (const struct if_nameindex* one = all; one != nullptr && one->if_name != nullptr; ++one) {
    if (is_can(socket, one->if_name)) names.emplace_back(one->if_name);
  }
  if (all != nullptr) ::if_freenameindex(all);
  if (names.empty()) return "it has none; use local:NAME";
  return fmt::format("it has: {}", fmt::join(names, ", "));
}

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

/// Nothing, or why this interface cannot be used.
std::optional<std::string> objection(int socket, std::string_view interface, bool fd) {
  ifreq request = request_for(interface);
  if (interface.size() >= IFNAMSIZ || ::ioctl(socket, SIOCGIFINDEX, &request) != 0) {
    return fmt::format("no CAN interface '{}' on this machine; {}", interface, can_interfaces(socket));
  }
  if (!is_can(socket, interface)) {
    return fmt::format("'{}' is not a CAN interface of this machine; {}", interface, can_interfaces(socket));
  }
  if (::ioctl(socket, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0) {
    return fmt::format("CAN interface '{0}' is down: `ip link set {0} up`", interface);
  }
  if (fd && (::ioctl(socket, SIOCGIFMTU, &request) != 0 || request.ifr_mtu < static_cast<int>(CANFD_MTU))) {
    return fmt::format(
        "CAN interface '{0}' is classic (mtu {1}) and CAN FD was asked for: `ip link set {0} type can "
        "... fd on` (vcan: `ip link set {0} mtu 72`)",
        interface, request.ifr_mtu);
  }
  return std::nullopt;
}

template <class T>
bool set(int socket, int level, int option, const T& value) {
  return ::setsockopt(socket, level, option, &value, sizeof value) == 0;
}

/// Which frames to receive: the ids, or all; never remote frames.
bool set_filters(int socket, const std::vector<std::uint32_t>& only_ids) {
  std::vector<can_filter> filters;
  filters.reserve(only_ids.size() + 1);
  for (const std::uint32_t id : only_ids) {
    filters.push_back({.can_id = id, .can_mask = CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  if (filters.empty()) filters.push_back({.can_id = 0, .can_mask = CAN_RTR_FLAG});
  return ::setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                      static_cast<socklen_t>(filters.size() * sizeof(can_filter))) == 0;
}

bool configure(int socket, const PortOptions& options) {
  const int stamps = SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE | SOF_TIMESTAMPING_RX_HARDWARE |
                     SOF_TIMESTAMPING_RAW_HARDWARE;
  const can_err_mask_t all_errors = CAN_ERR_MASK;
  const int on = 1;
  const int own = options.own_echo ? 1 : 0;
  const int smallest = 0;  // the kernel's minimum, see the header
  return set_filters(socket, options.only_ids) && set(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, all_errors) &&
         set(socket, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, own) &&
         set(socket, SOL_SOCKET, SO_TIMESTAMPING, stamps) && set(socket, SOL_SOCKET, SO_RXQ_OVFL, on) &&
         set(socket, SOL_SOCKET, SO_SNDBUF, smallest) &&
         (!options.fd || set(socket, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, on)) &&
         (options.receive_buffer_bytes == 0 ||
          set(socket, SOL_SOCKET, SO_RCVBUF, options.receive_buffer_bytes));
}

}  // namespace

Result<std::unique_ptr<Port>> open_socketcan(std::string_view interface, const PortOptions& options) {
  const auto wide =
      std::ranges::find_if(options.only_ids, [](std::uint32_t id) { return id > max_standard_id; });
  if (wide != options.only_ids.end()) {
    return failure(fmt::format("only_ids: 0x{:X} is not a standard id (0 to 0x7FF)", *wide));
  }
  Descriptor socket(::socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (!socket) return failure(no_socket(interface, errno));
  if (auto why = objection(socket.get(), interface, options.fd)) return failure(std::move(*why));

  sockaddr_can at{};
  at.can_family = AF_CAN;
  at.can_ifindex = static_cast<int>(::if_nametoindex(std::string(interface).c_str()));
  if (!configure(socket.get(), options) ||
      ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0) {
    return failure(fmt::format("cannot open '{}': {}", interface, std::strerror(errno)));
  }
  return std::make_unique<SocketCan>(std::move(socket), std::string(interface), options.fd);
}

}  // namespace canhil
