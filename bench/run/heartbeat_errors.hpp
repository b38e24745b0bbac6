// The error bits of a heartbeat, in words.
#pragma once

#include <string>

#include "messages/canhil.hpp"

namespace canhil::run {

/// "input_lost, numeric" as the DBC names them, or "none".
std::string errors_of(const messages::TargetHeartbeat& heartbeat);

/// Why a run ends whose target is in the state fault.
std::string fault_of(const messages::TargetHeartbeat& heartbeat);

}  // namespace canhil::run
