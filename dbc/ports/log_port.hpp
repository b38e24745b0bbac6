// A recorded log as a bus.
#pragma once

#include <memory>
#include <string_view>

#include "dbc/ports/port.hpp"

namespace canhil {

/// Opens `log:FILE` as a bus that carries only the recorded frames: receive() returns them without waiting,
/// with their recorded times (StampSource::process), and the port closes after the last one. Sent frames are
/// discarded. The whole log is checked on opening.
Result<std::unique_ptr<Port>> open_log_port(std::string_view bus, const PortOptions& options);

}  // namespace canhil
