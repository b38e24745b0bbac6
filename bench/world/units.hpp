// Factors from the units of scenarios and reports to SI and radians: value_deg * deg is in radians.
#pragma once

#include <numbers>

namespace canhil::world::units {

inline constexpr double standard_gravity = 9.80665;  // [m/s^2]
inline constexpr double hour = 3600.0;               // [s]

inline constexpr double deg = std::numbers::pi / 180.0;
inline constexpr double mrad = 1e-3;
inline constexpr double urad = 1e-6;
inline constexpr double kmph = 1.0 / 3.6;
inline constexpr double degph = deg / hour;
inline constexpr double degprth = deg / 60.0;  // deg/sqrt(h) -> rad/sqrt(s)
inline constexpr double ug = 1e-6 * standard_gravity;
inline constexpr double ugprthz = ug;              // ug/sqrt(Hz) -> m/s/sqrt(s)
inline constexpr double degphprth = degph / 60.0;  // deg/h/sqrt(h) -> rad/s/sqrt(s)
inline constexpr double ugprth = ug / 60.0;        // ug/sqrt(h) -> m/s^2/sqrt(s)
inline constexpr double ppm = 1e-6;

}  // namespace canhil::world::units
