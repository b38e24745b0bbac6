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

/// Density and speed of sound of the standard atmosphere (ISO 2533) at an altitude [m]. The temperature falls
/// by 6.5 K per km up to 11 km and is constant above. The altitude is clamped to the range.
Air standard_atmosphere(double altitude);

}  // namespace canhil::wind
