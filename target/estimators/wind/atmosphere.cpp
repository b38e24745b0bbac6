#include "target/estimators/wind/atmosphere.hpp"

#include <algorithm>
#include <cmath>

namespace canhil::wind {

Air standard_atmosphere(double altitude) {
  constexpr double T0 = 288.15, p0 = 101'325, lapse = 0.0065, R = 287.05287, tropopause = 11'000;
  const double h = std::clamp(altitude, -2000.0, 20'000.0);
  const double T = T0 - lapse * std::min(h, tropopause);
  double p = p0 * std::pow(T / T0, 5.2558797);
  if (h > tropopause) p *= std::exp(-gravity * (h - tropopause) / (R * T));
  return {p / (R * T), std::sqrt(1.4 * R * T)};
}

}  // namespace canhil::wind
