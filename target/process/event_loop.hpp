// The process around the device: waits for frames, passes them to the device, sends the answers, and measures
// its own timing.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::target {

/// Receives on every bus and answers on the first bus, until `stop` is set or a bus is closed. All buses have
/// the same `format`. Error: a bus cannot be opened, or another target already answers on one of the buses.
Result<void> serve(const std::vector<std::string>& buses, BusFormat format, const std::atomic<bool>& stop);
/// Serves an open port. Error: another target already answers on its bus.
Result<void> serve(Port& port, BusFormat format, const std::atomic<bool>& stop);

}  // namespace canhil::target
