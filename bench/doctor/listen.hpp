// Detects traffic on the bus, and a target by its heartbeat.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/doctor/line.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::doctor {

/// Listens for `duration_ns` or until stop() returns true, and sends nothing. Returns a line about the
/// traffic and a line about the heartbeat of a target.
std::vector<Line> listen(Port& port, std::int64_t duration_ns, const std::function<bool()>& stop);

}  // namespace canhil::doctor
