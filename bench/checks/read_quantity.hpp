// The key `quantity` of a check or a metric.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "bench/quantities/quantity.hpp"

namespace canhil::scenario {
class Section;
}

namespace canhil::checks {

/// The key that consists of `stem` and the suffix of a unit.
std::string key_of(std::string_view stem, const quantities::Unit& unit);

/// The quantity among `known` whose name is the value of the key `quantity`. `refused`: returns why a
/// quantity is not allowed here, as text after "'NAME' "; empty: it is allowed. Error: an unknown, former or
/// refused name; the return value is then an allowed quantity.
const quantities::Quantity* read_quantity(
    scenario::Section& section, std::span<const quantities::Quantity* const> known,
    const std::function<std::string(const quantities::Quantity&)>& refused);

}  // namespace canhil::checks
