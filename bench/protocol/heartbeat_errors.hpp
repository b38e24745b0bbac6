// The error bits of a heartbeat as text.
#pragma once

#include <optional>
#include <string>

#include "dbc/ports/port.hpp"
#include "messages/canhil.hpp"

namespace canhil::protocol {

/// "input_lost, numeric" with the DBC's names, or "none".
std::string errors_of(const messages::TargetHeartbeat& heartbeat);

/// The reason for the end of a run, from a heartbeat that reports the state `fault`.
std::string fault_of(const messages::TargetHeartbeat& heartbeat);

/// The heartbeat in a received frame, if it reports the state `fault` of an estimator; otherwise none.
std::optional<messages::TargetHeartbeat> fault_in(const Received& received);

}  // namespace canhil::protocol
