// The process around the device: waits for frames, hands them over, sends the answers, measures itself.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::target {

/// Listens on every bus, of either contract, and answers on the first, until `stop` is set or a bus is gone.
/// Error: a bus cannot be opened.
Result<void> serve(const std::vector<std::string>& buses, BusFormat format, const std::atomic<bool>& stop);
/// The same on a port that is open. Error: a target answers there already.
Result<void> serve(Port& port, BusFormat format, const std::atomic<bool>& stop);

}  // namespace canhil::target
