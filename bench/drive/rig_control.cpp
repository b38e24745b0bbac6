#include "bench/drive/rig_control.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace canhil::drive {
namespace {

ifreq request_for(const std::string& bus) {
  ifreq request{};
  bus.copy(request.ifr_name, IFNAMSIZ - 1);
  return request;
}

// Sets an interface up or down. If `up` is absent, writes the flags of the interface back unchanged. Returns
// whether the kernel accepted the flags.
bool set_flag(const std::string& bus, std::optional<bool> up) {
  const int any = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (any < 0) return false;
  ifreq request = request_for(bus);
  bool taken = ioctl(any, SIOCGIFFLAGS, &request) == 0;
  if (up) {
    const int flags = *up ? request.ifr_flags | IFF_UP : request.ifr_flags & ~IFF_UP;
    request.ifr_flags = static_cast<short>(flags);
  }
  taken = taken && ioctl(any, SIOCSIFFLAGS, &request) == 0;
  close(any);
  return taken;
}

}  // namespace

InterfaceFacts interface_facts(const std::string& bus) {
  if (if_nametoindex(bus.c_str()) == 0) return {};
  std::error_code ignored;
  const bool has_device = std::filesystem::exists("/sys/class/net/" + bus + "/device", ignored);
  return {.kind = has_device ? faults::Place::Interface::controller : faults::Place::Interface::virtual_can,
          .may_set = set_flag(bus, std::nullopt)};  // writes the flags unchanged: a test of permission
}

RunRigControl::RunRigControl(std::string bus, TargetPrograms& targets, Link& link,
                             std::function<void(std::int64_t)> restart)
    : bus_(std::move(bus)), targets_(targets), link_(link), restart_(std::move(restart)) {}

RunRigControl::~RunRigControl() {
  interface_up();
  if (errors_ >= 0) close(errors_);
}

// A bus that takes nothing is noticed by the next step.
void RunRigControl::flush() {
  constexpr std::int64_t patience_ns = 5'000'000'000;
  static_cast<void>(link_.flush(patience_ns));
}

void RunRigControl::pause_target() {
  flush();
  targets_.send_signal(SIGSTOP);
}

void RunRigControl::restart_target(std::int64_t t_us) {
  flush();
  restart_(t_us);
}

void RunRigControl::resume_target() { targets_.send_signal(SIGCONT); }

// Sends the error frame through a separate socket. Therefore all listeners, including the bench, receive it
// as if it came from the driver.
void RunRigControl::report_error(const Frame& error) {
  flush();
  if (errors_ < 0) {
    errors_ = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
    if (errors_ < 0) return;
    setsockopt(errors_, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0);  // this socket receives nothing
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex(bus_.c_str()));
    if (bind(errors_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      close(std::exchange(errors_, -1));
      return;
    }
  }
  can_frame raw{};
  raw.can_id = error.id | CAN_ERR_FLAG;
  raw.can_dlc = error.size;
  std::copy_n(error.data.begin(), CAN_MAX_DLEN, raw.data);
  static_cast<void>(!write(errors_, &raw, sizeof raw));
}

// The loop that drives the run waits for the interface, so another thread must set the interface up again.
void RunRigControl::interface_down(std::int64_t for_us) {
  flush();
  interface_up();
  if (!set_flag(bus_, false)) return;
  up_ = std::thread([bus = bus_, for_us] {
    std::this_thread::sleep_for(std::chrono::microseconds(for_us));
    set_flag(bus, true);
  });
}

void RunRigControl::interface_up() {
  if (up_.joinable()) up_.join();
}

}  // namespace canhil::drive
