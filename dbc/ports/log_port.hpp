// A recorded log as a bus.
#pragma once

#include <memory>
#include <string_view>

#include "dbc/ports/port.hpp"

namespace canhil {

/// Opens `log:FILE` as a bus on which only the recorded frames are: receive() gives them at once, with their
/// times (StampSource::process), and the port closes after the last. Nobody hears what send() takes. The
/// whole log is checked on opening.
Result<std::unique_ptr<Port>> open_log_port(std::string_view bus, const PortOptions& options);

}  // namespace canhil
