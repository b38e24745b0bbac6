#include "bench/doctor/interface.hpp"

#include <fmt/format.h>
#include <linux/can/netlink.h>
#include <linux/ethtool.h>
#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <linux/sockios.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cstring>

#include "dbc/ports/descriptor.hpp"

namespace canhil::doctor {
namespace {

using Bytes = std::span<const std::byte>;

// Copies a value of type T from the bytes of a kernel message; bytes that are missing are taken as zero.
template <class T>
T value_of(Bytes payload) {
  T value{};
  if (!payload.empty()) std::memcpy(&value, payload.data(), std::min(payload.size(), sizeof value));
  return value;
}

std::string text_of(Bytes payload) {
  std::string text(reinterpret_cast<const char*>(payload.data()), payload.size());
  return text.substr(0, text.find('\0'));
}

// Calls visit(type, payload) for each netlink attribute in `bytes`.
template <class Visit>
void attributes(Bytes bytes, Visit&& visit) {
  while (bytes.size() >= sizeof(rtattr)) {
    const auto header = value_of<rtattr>(bytes);
    if (header.rta_len < sizeof header || header.rta_len > bytes.size()) return;
    visit(header.rta_type & NLA_TYPE_MASK, bytes.subspan(sizeof header, header.rta_len - sizeof header));
    bytes = bytes.subspan(std::min<std::size_t>(bytes.size(), RTA_ALIGN(header.rta_len)));
  }
}

BitTiming timing_of(Bytes payload) {
  const auto timing = value_of<can_bittiming>(payload);
  return {.bitrate = timing.bitrate, .sample_point_permille = timing.sample_point};
}

Controller controller_of(Bytes data) {
  Controller controller;
  attributes(data, [&](int type, Bytes payload) {
    switch (type) {
      case IFLA_CAN_BITTIMING:
        controller.nominal = timing_of(payload);
        break;
      case IFLA_CAN_DATA_BITTIMING:
        controller.data = timing_of(payload);
        break;
      case IFLA_CAN_STATE:
        controller.state = value_of<std::uint32_t>(payload);
        break;
      case IFLA_CAN_CTRLMODE:
        controller.mode = value_of<can_ctrlmode>(payload).flags;
        break;
      case IFLA_CAN_RESTART_MS:
        controller.restart_ms = value_of<std::uint32_t>(payload);
        break;
      case IFLA_CAN_BERR_COUNTER: {
        const auto errors = value_of<can_berr_counter>(payload);
        controller.transmit_errors = errors.txerr;
        controller.receive_errors = errors.rxerr;
        break;
      }
      case IFLA_CAN_TERMINATION:
        controller.termination_ohm = value_of<std::uint16_t>(payload);
        break;
      default:
        break;
    }
  });
  return controller;
}

void read_statistics(Bytes payload, Controller& controller) {
  const auto counts = value_of<can_device_stats>(payload);
  controller.bus_errors = counts.bus_error;
  controller.warnings = counts.error_warning;
  controller.passives = counts.error_passive;
  controller.bus_offs = counts.bus_off;
  controller.restarts = counts.restarts;
}

void read_link_info(Bytes info, Interface& interface) {
  Bytes data, statistics;
  attributes(info, [&](int type, Bytes payload) {
    if (type == IFLA_INFO_KIND) interface.kind = text_of(payload);
    if (type == IFLA_INFO_DATA) data = payload;
    if (type == IFLA_INFO_XSTATS) statistics = payload;
  });
  if (interface.kind != "can" || data.empty()) return;
  interface.controller = controller_of(data);
  read_statistics(statistics, *interface.controller);
}

// Sends an ethtool request to the kernel. False: the driver does not support the request.
template <class Request>
bool ethtool(const std::string& name, Request& request) {
  const Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq envelope{};
  std::memcpy(envelope.ifr_name, name.data(), std::min<std::size_t>(name.size(), IFNAMSIZ - 1));
  envelope.ifr_data = reinterpret_cast<char*>(&request);
  return ::ioctl(socket.get(), SIOCETHTOOL, &envelope) == 0;
}

std::string driver_of(const std::string& name) {
  ethtool_drvinfo info{};
  info.cmd = ETHTOOL_GDRVINFO;
  if (!ethtool(name, info)) return "";
  return info.bus_info[0] != '\0' ? fmt::format("{} at {}", info.driver, info.bus_info) : info.driver;
}

}  // namespace

Interface read_link(Bytes message) {
  Interface interface;
  if (message.size() < sizeof(ifinfomsg)) return interface;
  const auto header = value_of<ifinfomsg>(message);
  interface.is_can = header.ifi_type == ARPHRD_CAN;
  interface.up = (header.ifi_flags & IFF_UP) != 0;
  attributes(message.subspan(NLMSG_ALIGN(sizeof header)), [&](int type, Bytes payload) {
    if (type == IFLA_IFNAME) interface.name = text_of(payload);
    if (type == IFLA_MTU) interface.mtu = value_of<std::uint32_t>(payload);
    if (type == IFLA_TXQLEN) interface.queue_length = value_of<std::uint32_t>(payload);
    if (type == IFLA_LINKINFO) read_link_info(payload, interface);
  });
  return interface;
}

std::optional<Interface> find_interface(const std::string& name) {
  const unsigned index = ::if_nametoindex(name.c_str());
  const Descriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  if (index == 0 || !socket) return std::nullopt;
  struct {
    nlmsghdr header;
    ifinfomsg link;
  } request{};
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_GETLINK;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.link.ifi_index = static_cast<int>(index);
  if (::send(socket.get(), &request, sizeof request, 0) < 0) return std::nullopt;
  std::array<std::byte, 32768> answer{};
  const ssize_t size = ::recv(socket.get(), answer.data(), answer.size(), 0);
  if (size < static_cast<ssize_t>(sizeof(nlmsghdr))) return std::nullopt;
  const Bytes received(answer.data(), static_cast<std::size_t>(size));
  if (value_of<nlmsghdr>(received).nlmsg_type != RTM_NEWLINK) return std::nullopt;
  Interface interface = read_link(received.subspan(NLMSG_ALIGN(sizeof(nlmsghdr))));
  interface.driver = driver_of(name);
  ethtool_ts_info stamps{};
  stamps.cmd = ETHTOOL_GET_TS_INFO;
  if (ethtool(name, stamps)) interface.stamping = stamps.so_timestamping;
  return interface;
}

}  // namespace canhil::doctor
