#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/netlink.h>
#include <linux/net_tstamp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>

#include "bench/doctor/interface.hpp"
#include "dbc/ports/descriptor.hpp"

namespace canhil::doctor {
namespace {

constexpr std::uint32_t least_bitrate =
    500'000;  // at this rate, transfer alignment alone loads the bus by less than 50 %
// Sample points in this range cause no warning. By default, the kernel follows the recommendation of CiA: for
// bit rates above 800 kbit/s the sample point is at 75 %, for bit rates up to 500 kbit/s at 87.5 %.
constexpr std::uint32_t earliest_sample_permille = 750, latest_sample_permille = 900;
// Queue lengths in this range cause no warning. The queue must have room for the largest group of the DBC.
// But it must not be too long, because a frame at its end waits for all frames before it.
constexpr std::uint32_t shortest_queue = 10, longest_queue = 1000;

Line state_line(const std::string& name, const Controller& controller) {
  constexpr std::array<std::string_view, CAN_STATE_MAX> names{
      "error-active", "error-warning", "error-passive", "bus-off", "stopped", "sleeping"};
  const std::string found =
      fmt::format("{}, error counters tx {} rx {}",
                  controller.state < names.size() ? names.at(controller.state) : "unknown",
                  controller.transmit_errors, controller.receive_errors);
  const std::string wiring =
      "look for a second node that is switched on with the same bit rate, CAN high and low not crossed, and "
      "60 "
      "ohm between them (120 at each end)";
  switch (controller.state) {
    case CAN_STATE_ERROR_ACTIVE:
      return {Grade::good, "state", found};
    case CAN_STATE_ERROR_WARNING:
      return {Grade::weak, "state", found, wiring};
    case CAN_STATE_ERROR_PASSIVE:
      return {Grade::bad, "state", found, wiring};
    default:
      return {Grade::bad, "state", found,
              fmt::format("{}; then `ip link set {} type can restart`, or set it down and up", wiring, name)};
  }
}

Line bitrate_line(const std::string& name, const Controller& controller) {
  const std::string found =
      controller.data.bitrate > 0
          ? fmt::format("{} bit/s, data phase {} bit/s", controller.nominal.bitrate, controller.data.bitrate)
          : fmt::format("{} bit/s", controller.nominal.bitrate);
  if (controller.nominal.bitrate >= least_bitrate) return {Grade::good, "bit rate", found};
  return {
      Grade::weak, "bit rate", found,
      fmt::format("`ip link set {0} down; ip link set {0} type can bitrate 1000000; ip link set {0} up`, on "
                  "every node",
                  name)};
}

Line sample_point_line(const std::string& name, const Controller& controller) {
  const std::uint32_t point = controller.nominal.sample_point_permille;
  const std::string found = fmt::format("{:.1f} % of the bit", point / 10.0);
  if (point >= earliest_sample_permille && point <= latest_sample_permille)
    return {Grade::good, "sample point", found};
  return {Grade::weak, "sample point", found,
          fmt::format("`ip link set {} type can bitrate {} sample-point 0.875`, the same on every node", name,
                      controller.nominal.bitrate)};
}

Line mode_line(const std::string& name, const Controller& controller) {
  const auto has = [&](std::uint32_t flag) { return (controller.mode & flag) != 0; };
  if (has(CAN_CTRLMODE_LISTENONLY))
    return {Grade::bad, "mode", "listen-only: nothing can be sent",
            fmt::format("`ip link set {} type can listen-only off`", name)};
  if (has(CAN_CTRLMODE_LOOPBACK))
    return {Grade::bad, "mode", "loopback: nothing leaves the controller",
            fmt::format("`ip link set {} type can loopback off`", name)};
  if (has(CAN_CTRLMODE_ONE_SHOT))
    return {Grade::weak, "mode", "one-shot: a frame that meets another is lost",
            fmt::format("`ip link set {} type can one-shot off`", name)};
  return {Grade::good, "mode", "normal"};
}

Line restart_line(const std::string& name, const Controller& controller) {
  if (controller.restart_ms > 0)
    return {Grade::good, "restart", fmt::format("{} ms after bus-off", controller.restart_ms)};
  return {Grade::weak, "restart", "never after bus-off",
          fmt::format("`ip link set {} type can restart-ms 100` (while it is down)", name)};
}

Line errors_line(const Controller& controller) {
  const std::string found =
      fmt::format("{} bus errors, {} warnings, {} passive, {} bus-off, {} restarts since it was created",
                  controller.bus_errors, controller.warnings, controller.passives, controller.bus_offs,
                  controller.restarts);
  const bool none =
      controller.bus_errors + controller.warnings + controller.passives + controller.bus_offs == 0;
  if (none) return {Grade::good, "errors", found};
  return {Grade::weak, "errors", found,
          "see whether they grow during a run; then look at wiring, termination, bit rate and sample point"};
}

Line queue_line(const Interface& interface) {
  const std::string found = fmt::format("{} frames", interface.queue_length);
  if (interface.queue_length >= shortest_queue && interface.queue_length <= longest_queue)
    return {Grade::good, "queue", found};
  return {Grade::weak, "queue", found,
          fmt::format("`ip link set {} txqueuelen {}`", interface.name,
                      interface.queue_length < shortest_queue ? 100 : longest_queue)};
}

Line frames_line(const Interface& interface) {
  return {Grade::good, "frames", interface.mtu >= CANFD_MTU ? "classic and CAN FD" : "classic CAN"};
}

Line stamps_line(const Interface& interface) {
  const auto has = [&](std::uint32_t flags) { return (interface.stamping.value_or(0) & flags) == flags; };
  if (has(SOF_TIMESTAMPING_RX_HARDWARE | SOF_TIMESTAMPING_RAW_HARDWARE))
    return {Grade::good, "time stamps", "by the controller, and by the kernel"};
  // The kernel gives a time stamp to every frame that a driver delivers, even if the driver does not report
  // that it supports time stamps.
  if (!interface.controller) return {Grade::good, "time stamps", "by the kernel; there is no controller"};
  const bool usb = interface.driver.find("usb") != std::string::npos;
  if (!usb) return {Grade::good, "time stamps", "by the kernel, when the driver hands a frame over"};
  return {Grade::weak, "time stamps", "by the kernel, when USB brings a frame: up to a millisecond late",
          "a kernel or adapter whose driver stamps in hardware (see `ethtool -T`), or one on PCIe or SPI"};
}

}  // namespace

std::vector<Line> interface_lines(const Interface& interface) {
  const std::string& name = interface.name;
  const std::string what =
      fmt::format("{}: {}{}", name, interface.kind.empty() ? "no kind" : interface.kind,
                  interface.driver.empty() ? "" : fmt::format(", driver {}", interface.driver));
  if (!interface.is_can)
    return {{Grade::bad, "interface", what + "; not a CAN interface",
             "name a CAN interface: `ip -br link show type can` or type vcan"}};
  if (!interface.up) {
    const bool unset = interface.controller && interface.controller->nominal.bitrate == 0;
    return {{Grade::bad, "interface", what + "; down",
             unset ? fmt::format("`ip link set {0} up type can bitrate 1000000 restart-ms 100`", name)
                   : fmt::format("`ip link set {} up`", name)}};
  }
  std::vector<Line> lines{{Grade::good, "interface", what + "; up"}};
  if (interface.controller) {
    const Controller& controller = *interface.controller;
    lines.push_back(state_line(name, controller));
    lines.push_back(mode_line(name, controller));
    lines.push_back(bitrate_line(name, controller));
    lines.push_back(sample_point_line(name, controller));
    lines.push_back(restart_line(name, controller));
    lines.push_back(errors_line(controller));
    if (controller.termination_ohm)
      lines.push_back({Grade::good, "termination",
                       *controller.termination_ohm == 0
                           ? "switched off in the adapter"
                           : fmt::format("{} ohm in the adapter", *controller.termination_ohm)});
  }
  lines.push_back(frames_line(interface));
  lines.push_back(queue_line(interface));
  lines.push_back(stamps_line(interface));
  return lines;
}

std::vector<Line> mismatch_lines(const Interface& one, const Interface& other) {
  if (!one.controller || !other.controller) return {};
  const BitTiming &a = one.controller->nominal, &b = other.controller->nominal;
  if (a.bitrate == b.bitrate) return {};
  return {{Grade::bad, "bit rates",
           fmt::format("{} has {} bit/s, {} has {}", one.name, a.bitrate, other.name, b.bitrate),
           "the same on every node: each destroys the frames of the other"}};
}

Line no_interface(const std::string& name) {
  const Descriptor socket(::socket(AF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
  if (!socket && errno == EAFNOSUPPORT)
    return {Grade::bad, "interface", fmt::format("{}: this kernel has no CAN", name),
            "`modprobe can-raw`, a kernel that has it, or local:NAME"};
  return {Grade::bad, "interface", fmt::format("{}: there is no such interface", name),
          "plug the adapter in and load its driver (see `dmesg`), or `ip link add dev vcan0 type vcan`"};
}

}  // namespace canhil::doctor
