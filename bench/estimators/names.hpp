// Names of the contract's values.
#pragma once

#include <array>
#include <string_view>

namespace canhil::estimators {

/// Those of these values of an enumeration, in their order.
template <class... Values>
constexpr std::array<std::string_view, sizeof...(Values)> names_of(Values... values) {
  return {name_of(values)...};
}

}  // namespace canhil::estimators
