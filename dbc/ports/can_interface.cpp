#include "dbc/ports/can_interface.hpp"

#include <fmt/format.h>
#include <linux/can.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

namespace canhil {
namespace {

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

// After a title come lines "  vcan0   123  000007ff  ...  raw"; 'any' stands for a socket of all interfaces.
std::size_t entries_of(std::istream& receive_list, std::string_view interface) {
  std::size_t count = 0;
  for (std::string line; std::getline(receive_list, line);) {
    std::string device;
    std::istringstream(line) >> device;
    if (device == interface || device == "any") ++count;
  }
  return count;
}

}  // namespace

int interface_index(const std::string& interface) {
  return static_cast<int>(::if_nametoindex(interface.c_str()));
}

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

std::optional<std::size_t> receivers_on(std::string_view interface) {
  std::optional<std::size_t> count;
  for (const char* list : {"all", "fil", "inv", "sff", "eff", "err"}) {
    std::ifstream file(fmt::format("/proc/net/can/rcvlist_{}", list));
    if (file) count = count.value_or(0) + entries_of(file, interface);
  }
  return count;
}

}  // namespace canhil
