// Numbers as reports and the live view write them.
#pragma once

#include <cmath>

namespace canhil::report {

/// Rounds to the number of significant digits that a picture can show.
inline double rounded(double value, int digits = 5) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - (digits - 1));
  return std::round(value / unit) * unit;
}

}  // namespace canhil::report
