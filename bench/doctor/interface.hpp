// What the kernel tells of a CAN interface (rtnetlink and ethtool), and what is to be thought of it.
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
  std::uint32_t sample_point_permille = 0;  ///< of the bit
};

/// A CAN controller with its bit timing (kind "can"); vcan has none.
struct Controller {
  BitTiming nominal{}, data{};
  std::uint32_t state = 0;                                ///< CAN_STATE_*
  std::uint32_t mode = 0;                                 ///< CAN_CTRLMODE_*
  std::uint32_t restart_ms = 0;                           ///< after bus-off; 0: never by itself
  std::uint16_t transmit_errors = 0, receive_errors = 0;  ///< its error counters
  std::optional<std::uint16_t> termination_ohm{};         ///< where the driver can switch it
  std::uint32_t bus_errors = 0, warnings = 0, passives = 0, bus_offs = 0, restarts = 0;  ///< since it was up
};

/// A network interface.
struct Interface {
  std::string name;
  bool is_can = false;
  bool up = false;
  std::string kind;    ///< can, vcan, vxcan, slcan
  std::string driver;  ///< and where it sits: "gs_usb at usb-0000:00:14.0-1"
  std::uint32_t mtu = 0;
  std::uint32_t queue_length = 0;
  std::optional<Controller> controller{};
  std::optional<std::uint32_t> stamping{};  ///< SOF_TIMESTAMPING_*; none: the driver does not say
};

/// Reads the payload of an RTM_NEWLINK message (from its ifinfomsg on) as the kernel sent it. Damaged ones
/// give what could be read.
Interface read_link(std::span<const std::byte> message);

/// Asks the kernel. None: there is no interface of this name.
std::optional<Interface> find_interface(const std::string& name);

/// Judges a CAN interface for this bench: a line each for interface, state, bit rate, sample point, frames,
/// queue, restart, errors, stamps. Nothing beyond the first line if it is none or down.
std::vector<Line> interface_lines(const Interface& interface);

/// Two interfaces that are to share a bus: a line if their bit rates differ.
std::vector<Line> mismatch_lines(const Interface& one, const Interface& other);

/// In place of that for a name that no interface has.
Line no_interface(const std::string& name);

}  // namespace canhil::doctor
