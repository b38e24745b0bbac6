#include "tests/controller/guest.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "dbc/ports/descriptor.hpp"
#include "messages/canhil.hpp"
#include "tests/vcan/interface.hpp"

namespace canhil::test {
namespace {

void one_up(const std::string& interface, const std::string& options) {
  run(fmt::format("ip link set {} up type can {}", interface, options));
}

}  // namespace

void run(const std::string& command) { ASSERT_EQ(std::system(command.c_str()), 0) << command; }

void set_up(const std::string& can0_options, const std::string& can1_options) {
  run("ip link set can0 down && ip link set can1 down");
  one_up("can0", can0_options);
  one_up("can1", can1_options);
}

void set_up_on_wire(const std::string& can0_options, const std::string& can1_options) {
  // canhil_wire attaches to the controllers when they are set up. Therefore the module must be loaded first.
  run("ip link set can0 down && ip link set can1 down && "
      "{ [ -d /sys/module/canhil_wire ] || insmod \"$CANHIL_WIRE\"; }");
  wire("can0 sound");
  wire("can1 sound");
  set_up("bitrate 1000000 restart-ms 0 " + can0_options, "bitrate 1000000 restart-ms 0 " + can1_options);
}

void set_interface(const std::string& interface, bool up) {
  const Descriptor socket(::socket(AF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  ASSERT_EQ(::ioctl(socket.get(), SIOCGIFFLAGS, &request), 0);
  request.ifr_flags = static_cast<short>(up ? request.ifr_flags | IFF_UP : request.ifr_flags & ~IFF_UP);
  ASSERT_EQ(::ioctl(socket.get(), SIOCSIFFLAGS, &request), 0);
}

void await_carrier(const std::string& interface, bool there) {
  const std::string file = fmt::format("/sys/class/net/{}/carrier", interface);
  const std::string expected = there ? "1\n" : "0\n";
  const std::int64_t deadline_ns = in_seconds(30);
  while (read(file) != expected) {
    ASSERT_LT(clock_ns(CLOCK_MONOTONIC), deadline_ns) << interface << " has a carrier: " << read(file);
    ::usleep(1000);
  }
}

void await_syncs(int count) {
  const auto listener = open("can0", {.only_ids = {messages::Sync::info.id}});
  const std::int64_t deadline_ns = in_seconds(30);
  while (count > 0) {
    ASSERT_LT(clock_ns(CLOCK_MONOTONIC), deadline_ns) << "the bench is not heard";
    wait(*listener, WaitFor::frame, deadline_ns);
    while (listener->receive()) --count;
  }
}

void wire(const std::string& what) {
  std::ofstream file("/sys/module/canhil_wire/parameters/wire");
  ASSERT_TRUE(file << what << std::flush) << what;
}

Target::Target() {
  // The constructor does not wait for the first heartbeat of the target, because the bench waits for it.
  const Ended started = shell(fmt::format("{} --bus can0 >{} 2>{} & echo $!", HIL_TARGET,
                                          scratch("target.out"), scratch("target.err")));
  pid_ = started.out;
}

Target::~Target() { shell("kill " + pid_); }

std::string Target::said() const { return read(scratch("target.err")); }

Ended bench_run(const std::string& arguments) {
  return shell(fmt::format("timeout 120 {} run --bus can1 --target none {}", HIL_BENCH, arguments));
}

std::string outcome_of(const nlohmann::json& report, const std::string& kind) {
  for (const auto& check : report["checks"]) {
    if (check["kind"] == kind) return check["outcome"];
  }
  return "no such check";
}

}  // namespace canhil::test
