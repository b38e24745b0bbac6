// What goes wrong on a CAN bus: error frames decoded (linux/can/error.h) and counted.
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
  error_warning,  ///< one is 96 or more
  error_passive,  ///< one is 128 or more
  bus_off,        ///< the transmit counter was 256: the controller takes no part in the bus
  restarted,      ///< it does again
  down,           ///< the interface is down or removed
  up              ///< it is up again
};
std::string_view name(BusEvent event);

/// Error frames by what they said; one frame may say several things.
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
  std::uint64_t protocol = 0;     ///< bit, form, stuff, CRC and acknowledgement errors with their kind
  std::uint64_t bus_error = 0;    ///< the controller's bus error interrupt, which comes with most of those
  std::uint64_t rx_overflow = 0;  ///< of the controller's own buffers: frames are lost before the kernel
  std::uint64_t tx_overflow = 0;
  std::uint64_t transceiver = 0;
  std::uint8_t tx_counter = 0;  ///< the controller's error counters as last told
  std::uint8_t rx_counter = 0;
  std::uint8_t tx_counter_max = 0;
  std::uint8_t rx_counter_max = 0;

  friend bool operator==(const BusErrors&, const BusErrors&) = default;
};

/// Counts an error frame; the change of state that it tells of, if it does: the gravest.
std::optional<BusEvent> add(BusErrors& errors, const Frame& error_frame);

/// What a controller saw of an error frame on the wire: as sender that a bit was not its own, as receiver six
/// equal bits in a row.
enum class SeenError : std::uint8_t { none, bit, stuff, acknowledgement };

/// What a controller has to tell its host.
struct ControllerNews {
  SeenError seen = SeenError::none;
  std::optional<BusEvent> event{};
  int tx_counter = 0;
  int rx_counter = 0;
};

/// The error frame by which Linux tells of it, with `berr-reporting on`.
Frame error_frame(const ControllerNews& news);

/// "bus off 1, restarted 1, no acknowledgement 12; error counters at most tx 136, rx 0"; empty without error
/// frames.
std::string to_text(const BusErrors& errors);

}  // namespace canhil
