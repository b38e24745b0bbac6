// What happened on the bus itself, beside the frames of its nodes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/ports/bus_errors.hpp"

namespace canhil::checks {

/// A change of state of the bench's controller or of its interface.
struct BusIncident {
  std::int64_t t_ns = 0;  ///< stamp of the port
  BusEvent event = BusEvent::error_active;
  std::uint8_t tx_counter = 0;  ///< the controller's error counters as told by then
  std::uint8_t rx_counter = 0;
};

struct BusRecord {
  bool reports_errors = false;  ///< of itself: where none was seen there was none
  /// A bus that goes from one state to the other all the time fills no memory.
  static constexpr std::size_t max_incidents = 1000;

  BusErrors errors;
  std::vector<BusIncident> incidents;  ///< the first max_incidents
  std::uint64_t more_incidents = 0;    ///< those after
  std::uint64_t downs = 0;             ///< how often the interface went down or was removed
  std::uint64_t late_in_queue = 0;     ///< frames of the bench that waited for room beyond their deadline
  std::map<std::string_view, std::uint64_t> intruded;  ///< frames of others under a message of the bench
  std::uint64_t foreign = 0;       ///< frames of others in the format that the bus's contract does not have
  std::vector<std::string> notes;  ///< who else troubled the bus and how, a line each
};

}  // namespace canhil::checks
