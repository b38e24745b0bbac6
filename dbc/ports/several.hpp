// Several buses as one: sensors on can0, aiding on can1.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/ports/port.hpp"

namespace canhil {

/// Which of several ports a frame is sent to: an index.
using PortRoute = std::function<std::size_t(const Frame&)>;

/// One port over several, at least one. A frame goes to the port that `route` names; of the frames that wait
/// the one with the oldest stamp comes first, so the order is that of the buses as far as they were read in
/// time. It is closed when one of them is, and has the name of the first. Error: their stamps are of
/// different clocks (an embedded bus beside SocketCAN).
Result<std::unique_ptr<Port>> join_ports(std::vector<std::unique_ptr<Port>> ports, PortRoute route);

/// join_or_host() for each name, joined.
Result<std::unique_ptr<Port>> open_buses(const std::vector<std::string>& buses, const PortOptions& options,
                                         BusFormat format, PortRoute route, const HubRules& rules);

/// open_bus() for each name, joined; all that is sent goes to the first.
Result<std::unique_ptr<Port>> open_buses(const std::vector<std::string>& buses, const PortOptions& options,
                                         BusFormat format = BusFormat::classic);

}  // namespace canhil
