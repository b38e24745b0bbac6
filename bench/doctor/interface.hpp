// The properties of a CAN interface according to the kernel (rtnetlink and ethtool), and how to judge them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/doctor/line.hpp"

namespace canhil::doctor {

/// Bit timing of one phase.
struct BitTiming {
  std::uint32_t bitrate = 0;                ///< bit/s; 0: not set
  std::uint32_t sample_point_permille = 0;  ///< sample point as a fraction of the bit time
};

/// A CAN controller with its bit timing (kind "can"); vcan has none.
struct Controller {
  BitTiming nominal{}, data{};
  std::uint32_t state = 0;                                ///< CAN_STATE_*
  std::uint32_t mode = 0;                                 ///< CAN_CTRLMODE_*
  std::uint32_t restart_ms = 0;                           ///< after bus-off; 0: never automatically
  std::uint16_t transmit_errors = 0, receive_errors = 0;  ///< error counters of the controller
  std::optional<std::uint16_t> termination_ohm{};         ///< none: the driver cannot switch it
  std::uint32_t bus_errors = 0, warnings = 0, passives = 0, bus_offs = 0,
                restarts = 0;  ///< since the interface was created
};

/// A network interface.
struct Interface {
  std::string name;
  bool is_can = false;
  bool up = false;
  std::string kind;    ///< can, vcan, vxcan, slcan
  std::string driver;  ///< driver and location: "gs_usb at usb-0000:00:14.0-1"
  std::uint32_t mtu = 0;
  std::uint32_t queue_length = 0;
  std::optional<Controller> controller{};
  std::optional<std::uint32_t> stamping{};  ///< SOF_TIMESTAMPING_*; none: not reported
};

/// Parses the payload of an RTM_NEWLINK message (from its ifinfomsg on). If the message is damaged, uses its
/// readable part.
Interface read_link(std::span<const std::byte> message);

/// Queries the kernel. None: there is no interface of this name.
std::optional<Interface> find_interface(const std::string& name);

/// Judges a CAN interface for use with this bench: one line each for interface, frames, queue and stamps. A
/// controller adds lines for state, mode, bit rate, sample point, restart, errors and, if known, termination.
/// Only the line `interface` if it is not a CAN interface or is down.
std::vector<Line> interface_lines(const Interface& interface);

/// Compares two interfaces on the same bus: one line if their bit rates differ.
std::vector<Line> mismatch_lines(const Interface& one, const Interface& other);

/// The line for a name for which there is no interface.
Line no_interface(const std::string& name);

}  // namespace canhil::doctor
