// Decodes and counts CAN error frames (linux/can/error.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/wire/frame.hpp"

namespace canhil {

/// A change of state of the controller (ISO 11898-1:2015, fault confinement) or of its interface.
enum class BusEvent : std::uint8_t {
  error_active,   ///< both error counters are below 96 again
  error_warning,  ///< an error counter is 96 or more
  error_passive,  ///< an error counter is 128 or more
  bus_off,        ///< the transmit counter reached 256: the controller has left the bus
  restarted,      ///< the controller takes part in the bus again
  down,           ///< the interface is down or removed
  up              ///< the interface is up again
};
/// The name of an event, for reports.
std::string_view name(BusEvent event);

/// Counts of error frames by kind; one frame may report several kinds.
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
  std::uint64_t protocol = 0;     ///< protocol errors with their kind: bit, form, stuff, CRC, acknowledgement
  std::uint64_t bus_error = 0;    ///< bus error interrupts; most protocol errors come with one
  std::uint64_t rx_overflow = 0;  ///< the controller's own buffers overflowed, before the kernel read them
  std::uint64_t tx_overflow = 0;
  std::uint64_t transceiver = 0;
  std::uint8_t tx_counter = 0;  ///< the controller's error counters as last reported
  std::uint8_t rx_counter = 0;
  std::uint8_t tx_counter_max = 0;
  std::uint8_t rx_counter_max = 0;

  friend bool operator==(const BusErrors&, const BusErrors&) = default;
};

/// Counts an error frame. Returns the most severe change of state that it reports, if any.
std::optional<BusEvent> add(BusErrors& errors, const Frame& error_frame);

/// The error that a controller saw: as sender a bit that differs from the one sent, as receiver six equal
/// bits in a row.
enum class SeenError : std::uint8_t { none, bit, stuff, acknowledgement };

/// What a controller reports to its host.
struct ControllerNews {
  SeenError seen = SeenError::none;
  std::optional<BusEvent> event{};
  int tx_counter = 0;
  int rx_counter = 0;
};

/// The error frame with which Linux passes the controller's report on, with `berr-reporting on`.
Frame error_frame(const ControllerNews& news);

/// "bus off 1, restarted 1, no acknowledgement 12; error counters at most tx 136, rx 0"; empty without error
/// frames.
std::string to_text(const BusErrors& errors);

}  // namespace canhil
