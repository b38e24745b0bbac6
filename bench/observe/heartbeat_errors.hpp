// The error bits of a heartbeat, in words.
#pragma once

#include <optional>
#include <string>

#include "dbc/ports/port.hpp"
#include "messages/canhil.hpp"

namespace canhil::observe {

/// "input_lost, numeric" as the DBC names them, or "none".
std::string errors_of(const messages::TargetHeartbeat& heartbeat);

/// Why a run ends whose target is in the state fault.
std::string fault_of(const messages::TargetHeartbeat& heartbeat);

/// The heartbeat in what the bus gave, if it is one that says that an estimator has stopped.
std::optional<messages::TargetHeartbeat> fault_in(const Received& received);

}  // namespace canhil::observe
