// The key `quantity` of a check or a metric.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "bench/quantities/quantity.hpp"

namespace canhil::scenario {
class Section;
}

namespace canhil::checks {

/// The quantity of `known` that the key `quantity` names. `refused`: why one may not be named here, after
/// "'NAME' "; empty: it may. Error: none may be named so, or under this name no more; then a quantity that is
/// harmless.
const quantities::Quantity* read_quantity(
    scenario::Section& section, std::span<const quantities::Quantity* const> known,
    const std::function<std::string(const quantities::Quantity&)>& refused);

}  // namespace canhil::checks
