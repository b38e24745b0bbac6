// From the names of buses to one port.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dbc/ports/fd_groups.hpp"
#include "dbc/ports/wire_settings.hpp"

namespace canhil::drive {

/// Virtual time, the device in this process. With '?bitrate=' and more a simulated wire lies between.
inline constexpr std::string_view in_process_bus = "in-process";
/// The same with frames that round nothing.
inline constexpr std::string_view unrounded_bus = "in-process?unrounded";

/// A bus as the command line names it, read once, to be opened. What the bus can do is then asked of its
/// port.
struct BusName {
  explicit BusName(std::string name = {})
      : text(std::move(name)),
        in_process(text.substr(0, text.find('?')) == in_process_bus),
        rounding(text == unrounded_bus ? Rounding::none : Rounding::as_on_the_bus),
        wire(wire_settings(text)) {}

  std::string text;           ///< as given to --bus
  bool in_process;            ///< no bus: the device is in this process
  Rounding rounding;          ///< of its frames
  Result<WireSettings> wire;  ///< what follows '?'
};

/// Nodes of the DBC, each with a bus of its own.
using BusOf = std::vector<std::pair<std::string, std::string>>;

struct OpenBuses {
  std::shared_ptr<std::vector<std::string>> notes;  ///< whom the bench as a host turned away, a line each
  std::unique_ptr<Port> port;                       ///< over all of them
};

/// A frame goes to the bus of its sender. A local bus is hosted by the bench, unless somebody does already.
/// Error: one line.
Result<OpenBuses> open_buses(const BusName& bus, const BusOf& bus_of, BusFormat format);

}  // namespace canhil::drive
