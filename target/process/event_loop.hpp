// The process around the device: waits for frames, hands them over, sends the answers, measures itself.
#pragma once

#include <atomic>
#include <string>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::target {

/// Serves a bus of either contract until `stop` is set or the bus is gone. Error: the bus cannot be opened.
Result<void> serve(const std::string& bus, BusFormat format, const std::atomic<bool>& stop);

}  // namespace canhil::target
