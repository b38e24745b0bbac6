// Units as DBC files write them, and what they are in SI.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace canhil::mapping {

struct WireUnit {
  std::string_view si;  ///< "rad/s"; empty: a plain number
  double factor = 1;    ///< from it to SI
};

/// What a DBC's unit means ("deg/s", "°/s", "g", "km/h", ...); none: nobody knows.
std::optional<WireUnit> wire_unit(std::string_view text);

/// All of them, for messages: "deg, rad, ...".
std::string wire_units();

}  // namespace canhil::mapping
