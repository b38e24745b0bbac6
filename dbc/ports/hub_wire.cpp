#include "dbc/ports/hub_wire.hpp"

#include <algorithm>
#include <ctime>

#include "dbc/ports/port.hpp"

namespace canhil::local {
HubWire::HubWire(const WireSettings& settings)
    : settings_(settings),
      frame_ns_(wire::duration_ns(wire::worst_case_length(8, false), settings.rates)),
      wire_(settings.rates, {{.order = settings.order, .reports_errors = true}, {}}, disturbance(settings)) {}

bool HubWire::has_room(std::size_t node) const {
  return wire_.waiting(node) < WireNode{}.depth && wire_.state(node) != NodeState::bus_off;
}

bool HubWire::queue(std::size_t node, const Frame& frame) {
  return wire_.queue(node, frame, clock_ns(CLOCK_MONOTONIC));
}

std::optional<Carried> HubWire::next() { return wire_.next(clock_ns(CLOCK_MONOTONIC)); }

void HubWire::set_alarm() {
  const std::int64_t at_ns = wire_.next_event_ns();
  timer_.set(at_ns == SimulatedWire::never ? 0 : std::max<std::int64_t>(at_ns, 1));
}

void HubWire::stop_alarm() { timer_.set(0); }

}  // namespace canhil::local
