// A port that reads a recorded log as if the log were a bus.
#pragma once

#include <memory>
#include <string_view>

#include "dbc/ports/port.hpp"

namespace canhil {

/// Opens `log:FILE` as a bus that carries only the recorded frames. receive() returns these frames without
/// waiting, with their recorded times (StampSource::process). The port closes after the last frame. Sent
/// frames are discarded. The whole log is checked when it is opened.
Result<std::unique_ptr<Port>> open_log_port(std::string_view bus, const PortOptions& options);

}  // namespace canhil
