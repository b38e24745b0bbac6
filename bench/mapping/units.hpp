// Units as DBC files write them, and their SI equivalents.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "dbc/parser/database.hpp"

namespace canhil::mapping {

struct WireUnit {
  std::string_view si;  ///< "rad/s"; empty: a plain number
  double factor = 1;    ///< to SI
};

/// The meaning of a DBC's unit ("deg/s", "°/s", "g", "km/h", ...); none: unknown.
std::optional<WireUnit> wire_unit(std::string_view text);

/// The lowest and the highest physical value of a signal; none: it can hold no value.
std::optional<std::pair<double, double>> physical_range(const dbc::Signal& signal);

/// All known units, as a list for error messages: "deg, rad, ...".
std::string wire_units();

}  // namespace canhil::mapping
