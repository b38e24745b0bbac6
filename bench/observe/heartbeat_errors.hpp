// The error bits of a heartbeat as text.
#pragma once

#include <optional>
#include <string>

#include "dbc/ports/port.hpp"
#include "messages/canhil.hpp"

namespace canhil::observe {

/// "input_lost, numeric" with the DBC's names, or "none".
std::string errors_of(const messages::TargetHeartbeat& heartbeat);

/// Why the run ends, for a target in state fault.
std::string fault_of(const messages::TargetHeartbeat& heartbeat);

/// The heartbeat in a received frame, if it reports that an estimator has stopped.
std::optional<messages::TargetHeartbeat> fault_in(const Received& received);

}  // namespace canhil::observe
