// Joins several buses into one port, for example if the sensors are on can0 and the aiding is on can1.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/ports/port.hpp"

namespace canhil {

/// A function that returns the index of the port to which a frame is sent.
using PortRoute = std::function<std::size_t(const Frame&)>;

/// Joins one or more ports into one port. `route` selects the port to which a frame is sent. receive()
/// returns, of all waiting frames, the frame with the oldest stamp. So frames are returned in the order in
/// which they were on the buses, if the ports are read in time. The joined port closes when one of its ports
/// closes, and has the name of the first port. Returns an error if the ports have stamps of different clocks,
/// for example if one bus is an embedded bus and another is a SocketCAN interface.
Result<std::unique_ptr<Port>> join_ports(std::vector<std::unique_ptr<Port>> ports, PortRoute route);

/// Calls join_or_host() for each name, and joins the ports.
Result<std::unique_ptr<Port>> open_buses(const std::vector<std::string>& buses, const PortOptions& options,
                                         BusFormat format, PortRoute route, const HubRules& rules);

/// Calls open_bus() for each name, and joins the ports. All frames are sent to the first bus.
Result<std::unique_ptr<Port>> open_buses(const std::vector<std::string>& buses, const PortOptions& options,
                                         BusFormat format = BusFormat::classic);

}  // namespace canhil
