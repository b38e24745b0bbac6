#include "target/estimators/strapdown/earth.hpp"

#include <cmath>

namespace canhil::strapdown {

LocalEarth local_earth(double latitude, double height) {
  LocalEarth earth;
  earth.sin_latitude = std::sin(latitude);
  earth.cos_latitude = std::cos(latitude);
  const double s2 = earth.sin_latitude * earth.sin_latitude;
  const double w2 = 1 - eccentricity_squared * s2;
  const double w = std::sqrt(w2);
  earth.transverse_radius = semi_major_axis / w;
  earth.meridian_radius = earth.transverse_radius * (1 - eccentricity_squared) / w2;
  earth.ellipsoid_gravity = 9.7803253359 * (1 + 0.00193185265241 * s2) / w;
  earth.gravity = earth.ellipsoid_gravity - free_air_gradient * height;
  earth.omega_ie_n << earth_rate * earth.cos_latitude, 0, -earth_rate * earth.sin_latitude;
  return earth;
}

}  // namespace canhil::strapdown
