#include "bench/drive/buses.hpp"

#include <algorithm>

#include "bench/drive/in_process_port.hpp"
#include "bench/drive/in_process_wire.hpp"
#include "dbc/ports/can_interface.hpp"
#include "dbc/ports/several.hpp"
#include "dbc/wire/message_places.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

static_assert(std::ranges::all_of(messages::all_messages, &MessageInfo::can_travel_unrounded));

// `format` matters only for a simulated wire: without a simulated wire, frames are not packed in containers.
Result<std::unique_ptr<Port>> open_in_process(const BusName& bus, BusFormat format) {
  const bool wireless = bus.rounding == Rounding::none || (bus.wire && bus.wire->rates.nominal == 0);
  if (wireless) return std::make_unique<InProcessPort>(bus.rounding);
  if (!bus.wire) return tl::unexpected(bus.wire.error());
  auto port = std::make_unique<InProcessWire>(bus.text, *bus.wire, format);
  if (format == BusFormat::fd) return in_fd_groups(std::move(port));
  return port;
}

// The ports of the bench are open: a receiver that comes later belongs to another program.
Others others_on(const BusName& bus, const std::shared_ptr<const std::optional<std::size_t>>& hosted) {
  if (bus.in_process) return {};
  if (*hosted) return {.count = [hosted] { return *hosted; }, .complete = true};
  const auto own = receivers_on(bus.text);
  if (!own) return {};
  return {.count = [interface = bus.text, own]() -> std::optional<std::size_t> {
    const auto all = receivers_on(interface);
    if (!all) return std::nullopt;
    return *all - std::min(*all, *own);
  }};
}

}  // namespace

Result<OpenBuses> open_buses(const BusName& bus, const BusOf& bus_of, BusFormat format,
                             const scenario::Binding* binding) {
  const auto notes = std::make_shared<std::vector<std::string>>();
  const auto nodes = std::make_shared<std::optional<std::size_t>>();  // of a local bus that the bench hosts
  const auto with_notes = [&](std::unique_ptr<Port> port) {
    return OpenBuses{notes, std::move(port), others_on(bus, nodes)};
  };
  if (bus.in_process) return open_in_process(bus, format).map(with_notes);
  std::vector<std::string> names{bus.text};  // no duplicates
  for (const auto& [node, own] : bus_of) {
    if (std::ranges::find(names, own) == names.end()) names.push_back(own);
  }
  PortOptions options;
  options.own_echo = true;
  options.foreign = true;
  options.node_name = "hil-bench";
  HubRules rules;
  rules.on_nodes = [nodes](std::size_t count) { *nodes = count; };
  rules.on_turned_away = [notes](const std::string& line) { notes->push_back(line); };
  const MessagePlaces places(bus_of.empty() || binding == nullptr ? std::span<const MessageInfo>()
                                                                  : binding->messages);
  const auto route = [names, bus_of, binding, places](const Frame& frame) -> std::size_t {
    const std::size_t place = places(frame);
    if (place == MessagePlaces::nowhere) return 0;
    const auto own =
        std::ranges::find(bus_of, binding->sender_of(binding->messages[place]), &BusOf::value_type::first);
    if (own == bus_of.end()) return 0;
    return static_cast<std::size_t>(std::ranges::find(names, own->second) - names.begin());
  };
  return canhil::open_buses(names, options, format, route, rules).map(with_notes);
}

}  // namespace canhil::drive
