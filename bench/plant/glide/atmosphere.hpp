// The standard atmosphere (ISO 2533), troposphere and lower stratosphere.
#pragma once

namespace canhil::plant::glide {

struct Air {
  double density = 0;         ///< [kg/m^3]
  double speed_of_sound = 0;  ///< [m/s]
};

/// The air at a height [m] between -2 km and 20 km. Outside this range, the values at the nearest end are
/// returned.
Air standard_air(double height);

}  // namespace canhil::plant::glide
