#include "dbc/ports/hub_wire.hpp"

#include <sys/timerfd.h>

#include <algorithm>
#include <ctime>

#include "dbc/ports/port.hpp"

namespace canhil::local {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

void set(int timer, std::int64_t at_ns) {
  itimerspec time{};  // zero: never
  time.it_value = {.tv_sec = static_cast<std::time_t>(at_ns / ns_per_s),
                   .tv_nsec = static_cast<long>(at_ns % ns_per_s)};
  ::timerfd_settime(timer, TFD_TIMER_ABSTIME, &time, nullptr);
}

}  // namespace

HubWire::HubWire(const WireSettings& settings)
    : order_(settings.order),
      frame_ns_(wire::duration_ns(wire::worst_case_length(8, false), settings.rates)),
      wire_(settings.rates, {{.order = settings.order, .told = true}, {}}, disturbance(settings)),
      timer_(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {}

bool HubWire::has_room(std::size_t node) const {
  return wire_.waiting(node) < WireNode{}.depth && wire_.state(node) != NodeState::bus_off;
}

bool HubWire::queue(std::size_t node, const Frame& frame) {
  return wire_.queue(node, frame, clock_ns(CLOCK_MONOTONIC));
}

std::optional<Carried> HubWire::next() { return wire_.next(clock_ns(CLOCK_MONOTONIC)); }

void HubWire::set_alarm() {
  const std::int64_t at_ns = wire_.next_event_ns();
  set(timer_.get(), at_ns == SimulatedWire::never ? 0 : std::max<std::int64_t>(at_ns, 1));
}

void HubWire::stop_alarm() { set(timer_.get(), 0); }

}  // namespace canhil::local
