// Units as DBC files write them, and their SI equivalents.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace canhil::quantities {

struct WireUnit {
  std::string_view si;  ///< "rad/s"; empty: a plain number
  double factor = 1;    ///< to SI
};

/// The meaning of a DBC's unit ("deg/s", "°/s", "g", "km/h", ...); none: unknown.
std::optional<WireUnit> wire_unit(std::string_view text);

/// All known units, as a list for error messages: "deg, rad, ...".
std::string wire_units();

}  // namespace canhil::quantities
