// The kinds of sensors.
#pragma once

#include <span>

#include "bench/sensors/kind.hpp"

namespace canhil::sensors {

/// All kinds, in the order in which they are listed in messages and pages.
std::span<const Kind* const> all();

}  // namespace canhil::sensors
