// The standard atmosphere (ISO 2533), troposphere and lower stratosphere.
#pragma once

namespace canhil::world::glide {

struct Air {
  double density = 0;         ///< [kg/m^3]
  double speed_of_sound = 0;  ///< [m/s]
};

/// Air at a height [m] from -2 km to 20 km; outside this range, the values at its nearest end.
Air standard_air(double height);

}  // namespace canhil::world::glide
