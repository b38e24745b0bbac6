#include "bench/drive/bus_facts.hpp"

namespace canhil::drive {

Capabilities known_of(const Port& port, const WireFacts& controller) {
  Capabilities bus = port.capabilities();
  if (bus.wire.rates.nominal == 0) bus.wire = controller;
  return bus;
}

observe::LoadBy load_by(const Capabilities& bus, ClockKind clock, bool time_base) {
  if (!time_base)
    return clock == ClockKind::lockstep ? observe::LoadBy::virtual_time : observe::LoadBy::stamps;
  if (clock == ClockKind::lockstep)
    return bus.in_process ? observe::LoadBy::time_base_alone : observe::LoadBy::time_base;
  return bus.wire.rates.nominal > 0 ? observe::LoadBy::stamps : observe::LoadBy::time_base;
}

}  // namespace canhil::drive
