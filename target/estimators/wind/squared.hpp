#pragma once

namespace canhil::wind {

/// value^2.
inline double squared(double value) { return value * value; }

}  // namespace canhil::wind
