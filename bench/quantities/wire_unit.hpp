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

/// The meaning of a DBC's unit ("deg/s", "°/s", "g", "km/h", ...); none: unknown. `si`: the unit that is
/// expected, because "G" is gauss or gravity.
std::optional<WireUnit> wire_unit(std::string_view text, std::string_view si = "");

/// The known units, or those of an SI unit, as a list for error messages: "deg, rad, ...".
std::string wire_units(std::optional<std::string_view> si = {});

}  // namespace canhil::quantities
