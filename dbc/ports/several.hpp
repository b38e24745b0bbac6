// Several buses as one: sensors on can0, aiding on can1.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/ports/port.hpp"

namespace canhil {

/// The index of the port to which a frame is sent.
using PortRoute = std::function<std::size_t(const Frame&)>;

/// Joins one or more ports into one. A frame is sent to the port that `route` names. Of the waiting received
/// frames the one with the oldest stamp comes first, which gives the order on the buses if they are read in
/// time. The joined port closes when one of its ports does, and has the name of the first. Error: the ports
/// stamp by different clocks (an embedded bus beside SocketCAN).
Result<std::unique_ptr<Port>> join_ports(std::vector<std::unique_ptr<Port>> ports, PortRoute route);

/// join_or_host() for each name, joined.
Result<std::unique_ptr<Port>> open_buses(const std::vector<std::string>& buses, const PortOptions& options,
                                         BusFormat format, PortRoute route, const HubRules& rules);

/// open_bus() for each name, joined; all frames are sent to the first.
Result<std::unique_ptr<Port>> open_buses(const std::vector<std::string>& buses, const PortOptions& options,
                                         BusFormat format = BusFormat::classic);

}  // namespace canhil
