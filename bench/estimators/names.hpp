// Names of values in the DBC's value tables.
#pragma once

#include <array>
#include <string_view>

namespace canhil::estimators {

/// The names of these values, in order.
template <class... Values>
constexpr std::array<std::string_view, sizeof...(Values)> names_of(Values... values) {
  return {name_of(values)...};
}

}  // namespace canhil::estimators
