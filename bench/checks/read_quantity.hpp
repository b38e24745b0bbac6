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

/// The key that begins with `stem` and ends in a unit.
std::string key_of(std::string_view stem, const quantities::Unit& unit);

/// The quantity of `known` that the key `quantity` names. `refused`: why one may not be named here, after
/// "'NAME' "; empty: it may. Error: none may be named so, or under this name no more; then a quantity that is
/// harmless.
const quantities::Quantity* read_quantity(
    scenario::Section& section, std::span<const quantities::Quantity* const> known,
    const std::function<std::string(const quantities::Quantity&)>& refused);

}  // namespace canhil::checks
