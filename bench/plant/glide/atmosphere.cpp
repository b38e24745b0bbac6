#include "bench/plant/glide/atmosphere.hpp"

#include <algorithm>
#include <cmath>

#include "bench/world/units.hpp"

namespace canhil::plant::glide {

// The pressure follows from hydrostatics: its derivative with respect to height is -rho g. The temperature
// decreases by 6.5 K/km up to 11 km, and is constant above.
Air standard_air(double height) {
  using world::units::standard_gravity;
  constexpr double gas_constant = 287.05287;  // [J/(kg K)]
  constexpr double adiabatic_index = 1.4;
  constexpr double ground_temperature = 288.15;  // [K]
  constexpr double ground_pressure = 101'325;    // [Pa]
  constexpr double lapse = 0.0065;               // [K/m]
  constexpr double tropopause = 11'000;          // [m]
  const double h = std::clamp(height, -2'000.0, 20'000.0);
  const double temperature = ground_temperature - lapse * std::min(h, tropopause);
  const double exponent = standard_gravity / (gas_constant * lapse);
  const double above = std::max(h - tropopause, 0.0);
  const double pressure = ground_pressure * std::pow(temperature / ground_temperature, exponent) *
                          std::exp(-standard_gravity * above / (gas_constant * temperature));
  return {.density = pressure / (gas_constant * temperature),
          .speed_of_sound = std::sqrt(adiabatic_index * gas_constant * temperature)};
}

}  // namespace canhil::plant::glide
