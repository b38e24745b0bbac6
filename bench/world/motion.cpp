#include "bench/world/motion.hpp"

namespace canhil::world {

Kinematics kinematics(const Motion& motion, double t) {
  return std::visit([t](const auto& m) { return kinematics(m, t); }, motion);
}

std::vector<std::int64_t> jumps_us(const Motion& motion) {
  if (const auto* flight = std::get_if<LevelAcceleration>(&motion)) return {flight->cruise_us};
  return {};
}

}  // namespace canhil::world
