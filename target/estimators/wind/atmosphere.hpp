#pragma once
// The international standard atmosphere, -2 to 20 km.

namespace canhil::wind {

/// Gravity of the model [m/s^2].
inline constexpr double gravity = 9.80665;

/// The state of the air.
struct Air {
  double density = 0;         // [kg/m^3]
  double speed_of_sound = 0;  // [m/s]
};

/// Density and speed of sound of the standard atmosphere at an altitude [m]: 6.5 K/km to 11 km, isothermal
/// above; the altitude is clamped to the range (ISO 2533).
Air standard_atmosphere(double altitude);

}  // namespace canhil::wind
