#include "bench/world/motion/depth_profile.hpp"

#include <cmath>
#include <numbers>

namespace canhil::world {

double steepest(const DepthProfile& profile) { return std::numbers::pi * profile.depth / profile.period; }

Dive dive(const DepthProfile& profile, double speed, double t) {
  if (profile.depth == 0) return {};
  const double w = 2.0 * std::numbers::pi / profile.period;
  const double slope = steepest(profile) / speed;
  const double sine = -slope * std::sin(w * t);
  return {.pitch = std::asin(sine), .rate = -slope * w * std::cos(w * t) / std::sqrt(1.0 - sine * sine)};
}

}  // namespace canhil::world
