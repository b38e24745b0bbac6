// Detects the nodes on the bus.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/doctor/line.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::doctor {

/// Listens for `duration_ns`, or until stop(), without sending, and reports the traffic and a target's
/// heartbeat.
std::vector<Line> listen(Port& port, std::int64_t duration_ns, const std::function<bool()>& stop);

}  // namespace canhil::doctor
