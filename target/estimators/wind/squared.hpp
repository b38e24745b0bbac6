#pragma once

namespace canhil::wind {

inline double squared(double value) { return value * value; }

}  // namespace canhil::wind
