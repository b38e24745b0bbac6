// Opens all buses that the command line names, and combines them in one port.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/scenario/binding.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/ports/wire_settings.hpp"

namespace canhil::drive {

/// The bus for a run in virtual time, with the device in this process. '?bitrate=...' adds a simulated wire.
inline constexpr std::string_view in_process_bus = "in-process";
/// Like `in_process_bus`, but the frames carry unrounded values.
inline constexpr std::string_view unrounded_bus = "in-process?unrounded";

/// A bus as given on the command line, parsed and ready to open. The opened port reports the properties of
/// the bus.
struct BusName {
  explicit BusName(std::string name = {})
      : text(std::move(name)),
        in_process(text.substr(0, text.find('?')) == in_process_bus),
        rounding(text == unrounded_bus ? Rounding::none : Rounding::as_on_the_bus),
        wire(wire_settings(text)) {}

  std::string text;           ///< as given to --bus
  bool in_process;            ///< no bus: the device runs in this process
  Rounding rounding;          ///< rounding of the values in its frames
  Result<WireSettings> wire;  ///< the part after '?'
};

/// Pairs (node, bus) for the nodes of the DBC that are not on the bus given to --bus.
using BusOf = std::vector<std::pair<std::string, std::string>>;

/// How many programs have joined the first bus beside the bench, as far as this machine knows.
struct Others {
  /// none: unknown. On a CAN interface, one program counts once for each of its filters.
  std::function<std::optional<std::size_t>()> count = [] { return std::nullopt; };
  bool complete = false;  ///< every node is counted, because the bench hosts the bus
};

struct OpenBuses {
  std::shared_ptr<std::vector<std::string>>
      notes;                   ///< one line for each program that the bench, as host of a local bus, rejected
  std::unique_ptr<Port> port;  ///< combines all buses
  Others others;
};

/// Opens the buses. The port sends each frame on the bus of the frame's sender, as the binding tells it. The
/// bench hosts a local bus unless another program already hosts this bus. `binding` must outlive the port.
/// Error: one line.
Result<OpenBuses> open_buses(const BusName& bus, const BusOf& bus_of, BusFormat format,
                             const scenario::Binding* binding = nullptr);

}  // namespace canhil::drive
