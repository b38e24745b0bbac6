// Angles that continue beyond half a turn.
#pragma once

#include <cmath>
#include <numbers>

namespace canhil::quantities {

/// An angle [rad], changed by whole turns so that it lies within half a turn of `near`.
inline double unwrapped(double angle, double near) {
  constexpr double turn = 2 * std::numbers::pi;
  return angle + turn * std::round((near - angle) / turn);
}

}  // namespace canhil::quantities
