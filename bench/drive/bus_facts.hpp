// Facts about the bus of a run.
#pragma once

#include "bench/drive/session.hpp"
#include "bench/observe/load_meter.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::drive {

/// The capabilities of a port. `controller`: the wire, if the port itself does not know its bit rate.
Capabilities known_of(const Port& port, const WireFacts& controller);

/// How the load of the bus is measured. `time_base`: the bench sends Sync.
observe::LoadBy load_by(const Capabilities& bus, ClockKind clock, bool time_base);

}  // namespace canhil::drive
