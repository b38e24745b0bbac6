// The kinds of sensors.
#pragma once

#include <span>

#include "bench/sensors/kind.hpp"

namespace canhil::sensors {

/// All kinds, in the order in which they are listed in messages and pages.
std::span<const Kind* const> all();

/// A sensor of a kind with a name of its own, so that a scenario may have several of them. Repeated calls
/// return the same object.
const Kind& named(const Kind& kind, std::string_view name);

}  // namespace canhil::sensors
