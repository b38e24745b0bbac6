// What a signal of a DBC that is read at run time can hold.
#pragma once

#include <optional>
#include <utility>

#include "dbc/parser/database.hpp"

namespace canhil::mapping {

/// The lowest and the highest physical value of a signal; none: it can hold no value.
std::optional<std::pair<double, double>> physical_range(const dbc::Signal& signal);

}  // namespace canhil::mapping
