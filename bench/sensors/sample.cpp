#include "bench/sensors/sample.hpp"

#include <algorithm>

namespace canhil::sensors {

std::optional<Place> place_of(const Outputs& outputs, std::string_view name) {
  constexpr std::string_view valid = "valid.";
  if (name.starts_with(valid)) {
    const auto flag = std::ranges::find(outputs.flags, name.substr(valid.size()));
    if (flag == outputs.flags.end()) return std::nullopt;
    return Place{.role = Role::validity, .index = static_cast<std::size_t>(flag - outputs.flags.begin())};
  }
  const auto value = std::ranges::find(outputs.values, name, &Output::name);
  if (value == outputs.values.end()) return std::nullopt;
  return Place{.index = static_cast<std::size_t>(value - outputs.values.begin())};
}

}  // namespace canhil::sensors
