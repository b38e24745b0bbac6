// Events of the bus itself, as opposed to its nodes' frames.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/ports/bus_errors.hpp"

namespace canhil::checks {

/// A state change of the bench's controller or of its interface.
struct BusIncident {
  std::int64_t t_ns = 0;  ///< stamp of the port
  BusEvent event = BusEvent::error_active;
  std::uint8_t tx_counter = 0;  ///< the controller's error counters at that time
  std::uint8_t rx_counter = 0;
};

struct BusRecord {
  bool reports_errors =
      false;  ///< the bus reports its own errors; if false, absence of errors proves nothing
  /// A bus that changes state continually must not fill the memory.
  static constexpr std::size_t max_incidents = 1000;

  BusErrors errors;
  std::vector<BusIncident> incidents;  ///< the first max_incidents
  std::uint64_t more_incidents = 0;    ///< the number of later incidents
  std::uint64_t downs = 0;             ///< how often the interface went down or was removed
  std::uint64_t late_in_queue =
      0;  ///< frames of the bench that waited for room in the queue; see Link::late_in_queue()
  std::map<std::string_view, std::uint64_t> intruded;  ///< by message of the bench: the number of frames that
                                                       ///< other nodes sent with the id of this message
  std::uint64_t foreign = 0;  ///< frames in the format (classic or FD) that the DBC of the bus does not use
  std::vector<std::string> notes;  ///< other disturbances of the bus: sender and effect, one line each

  /// "the bus was away 2 times": the interface was down, or the controller was bus-off. Empty: it never was.
  [[nodiscard]] std::string outages() const {
    const std::uint64_t times = downs + errors.bus_off;
    if (times == 0) return "";
    return "the bus was away " + std::to_string(times) + (times == 1 ? " time" : " times");
  }
};

}  // namespace canhil::checks
