// The properties of a CAN interface as the kernel reports them (rtnetlink and ethtool), and functions that
// judge these properties.
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

/// The bit timing of one phase of a frame: the nominal phase (arbitration) or the data phase.
struct BitTiming {
  std::uint32_t bitrate = 0;                ///< bit/s; 0: not set
  std::uint32_t sample_point_permille = 0;  ///< sample point as a fraction of the bit time
};

/// A CAN controller and its bit timing. An interface of kind "can" has a controller, an interface of kind
/// "vcan" has none.
struct Controller {
  BitTiming nominal{}, data{};
  std::uint32_t state = 0;       ///< CAN_STATE_*
  std::uint32_t mode = 0;        ///< CAN_CTRLMODE_*
  std::uint32_t restart_ms = 0;  ///< delay of the automatic restart after bus-off; 0: no automatic restart
  std::uint16_t transmit_errors = 0, receive_errors = 0;  ///< error counters of the controller
  std::optional<std::uint16_t> termination_ohm{};  ///< nullopt: the driver cannot switch the termination
  std::uint32_t bus_errors = 0, warnings = 0, passives = 0, bus_offs = 0,
                restarts = 0;  ///< number of events since the interface was created
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

/// Parses the payload of an RTM_NEWLINK message; the payload begins with the ifinfomsg. If the message is
/// damaged, parses the part that is readable.
Interface read_link(std::span<const std::byte> message);

/// Queries the kernel about an interface. Returns nullopt if there is no interface of this name.
std::optional<Interface> find_interface(const std::string& name);

/// Judges whether a CAN interface is suitable for this bench. Returns one line each for the interface, the
/// frames, the queue and the time stamps. If the interface has a controller, there are also lines for state,
/// mode, bit rate, sample point, restart, errors and, if known, termination. If the interface is down or is
/// not a CAN interface, returns only the line `interface`.
std::vector<Line> interface_lines(const Interface& interface);

/// Compares two interfaces that are on the same bus. Returns one line if their bit rates differ, otherwise no
/// line.
std::vector<Line> mismatch_lines(const Interface& one, const Interface& other);

/// The line which reports that there is no interface with this name.
Line no_interface(const std::string& name);

}  // namespace canhil::doctor
