#include "bench/world/glide/autopilot.hpp"

#include "bench/world/units.hpp"

namespace canhil::world::glide {

Fins commanded(const Euler& angles, const Vector3& omega, double pitch_integral) {
  constexpr double limit = 20 * units::deg;
  const Fins wanted(1.0 * angles.pitch + 0.4 * pitch_integral + 0.30 * omega.y(),
                    -0.8 * angles.roll - 0.25 * omega.x(), 0.30 * omega.z());
  return wanted.cwiseMax(-limit).cwiseMin(limit);
}

}  // namespace canhil::world::glide
