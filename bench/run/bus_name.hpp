// A bus as the command line names it.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "dbc/ports/wire_settings.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::run {

/// Virtual time, the device in this process. With '?bitrate=' and more a simulated wire lies between.
inline constexpr std::string_view in_process_bus = "in-process";
/// The same with frames that round nothing.
inline constexpr std::string_view unrounded_bus = "in-process?unrounded";

/// Read once, to be opened. What the bus can do is then asked of its port.
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

}  // namespace canhil::run
