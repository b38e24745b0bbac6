#include "bench/observe/bus_watch.hpp"

namespace canhil::observe {
namespace {

constexpr std::string_view bus_off = "the bus is off";
constexpr std::string_view down = "the interface is down";

}  // namespace

void BusWatch::received(const Received& received) {
  if (!received.frame.error) {
    if (outage_ && outage_->what == bus_off) end();  // any received frame proves that the bus works
    return;
  }
  const auto event = add(record_.errors, received.frame);
  if (!event) return;
  note(received.t_ns, *event);
  if (*event == BusEvent::bus_off) {
    begin(bus_off);
  } else if (outage_ && outage_->what == bus_off) {
    end();
  }
}

void BusWatch::interface_changed(bool up, std::int64_t t_ns) {
  note(t_ns, up ? BusEvent::up : BusEvent::down);
  if (up) return end();
  ++record_.downs;
  begin(down);
}

void BusWatch::note(std::int64_t t_ns, BusEvent event) {
  if (record_.incidents.size() == checks::BusRecord::max_incidents) {
    ++record_.more_incidents;
    return;
  }
  record_.incidents.push_back({.t_ns = t_ns,
                               .event = event,
                               .tx_counter = record_.errors.tx_counter,
                               .rx_counter = record_.errors.rx_counter});
}

void BusWatch::begin(std::string_view what) {
  outage_ = Outage{.what = what, .since_ns = outage_ ? outage_->since_ns : port_.monotonic_ns()};
}

void BusWatch::end() {
  outage_.reset();
  ended_ns_ = port_.monotonic_ns();
}

}  // namespace canhil::observe
