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

/// The name of a key: `stem`, followed by the suffix of the unit.
std::string key_of(std::string_view stem, const quantities::Unit& unit);

/// Reads the key `quantity` and returns the quantity that has this name among `known`. `refused`: returns why
/// a quantity is not allowed here, as a text that is put after the quoted name; empty: the quantity is
/// allowed. Error: the name is unknown or refused; the function then returns an allowed quantity.
const quantities::Quantity* read_quantity(
    scenario::Section& section, std::span<const quantities::Quantity* const> known,
    const std::function<std::string(const quantities::Quantity&)>& refused);

}  // namespace canhil::checks
