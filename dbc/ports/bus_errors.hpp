// Decodes and counts CAN error frames (linux/can/error.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/wire/frame.hpp"

namespace canhil {

/// A change of the state of the controller (ISO 11898-1:2015, fault confinement) or of its network interface.
enum class BusEvent : std::uint8_t {
  error_active,   ///< both error counters are below 96 again
  error_warning,  ///< an error counter is 96 or more
  error_passive,  ///< an error counter is 128 or more
  bus_off,        ///< the transmit counter reached 256: the controller has left the bus
  restarted,      ///< the controller takes part in the bus again
  down,           ///< the interface is down or removed
  up              ///< the interface is up again
};
/// The name of an event for use in reports.
std::string_view name(BusEvent event);

/// The numbers of error frames of each kind. A frame that reports several kinds is counted for each of them.
struct BusErrors {
  std::uint64_t frames = 0;
  std::uint64_t warning = 0;
  std::uint64_t passive = 0;
  std::uint64_t active = 0;
  std::uint64_t bus_off = 0;
  std::uint64_t restarted = 0;
  std::uint64_t lost_arbitration = 0;
  std::uint64_t no_ack = 0;
  std::uint64_t tx_timeout = 0;
  std::uint64_t protocol = 0;     ///< protocol errors for which the kind is known, such as bit or stuff error
  std::uint64_t bus_error = 0;    ///< bus error interrupts; most protocol errors cause an interrupt
  std::uint64_t rx_overflow = 0;  ///< the kernel did not read the controller's buffers in time
  std::uint64_t tx_overflow = 0;
  std::uint64_t transceiver = 0;
  std::uint8_t tx_counter = 0;  ///< the error counters of the controller in the last report
  std::uint8_t rx_counter = 0;
  std::uint8_t tx_counter_max = 0;
  std::uint8_t rx_counter_max = 0;

  friend bool operator==(const BusErrors&, const BusErrors&) = default;
};

/// Counts an error frame. Returns the most severe change of state that the frame reports; nullopt: it reports
/// no change.
std::optional<BusEvent> add(BusErrors& errors, const Frame& error_frame);

/// The error that a controller detected. bit: as sender, it read a bit that differs from the bit that it
/// sent. stuff: as receiver, it read six equal bits in a row.
enum class SeenError : std::uint8_t { none, bit, stuff, acknowledgement };

/// What a controller reports to its host computer.
struct ControllerNews {
  SeenError seen = SeenError::none;
  std::optional<BusEvent> event{};
  int tx_counter = 0;
  int rx_counter = 0;
};

/// The error frame that Linux, with `berr-reporting on`, makes from the report of a controller.
Frame error_frame(const ControllerNews& news);

/// The counts as text, such as "bus off 1, restarted 1, no acknowledgement 12; error counters at most tx 136,
/// rx 0". Empty if there were no error frames.
std::string to_text(const BusErrors& errors);

}  // namespace canhil
