#include "bench/world/motion.hpp"

#include <algorithm>

#include "bench/world/motion/leg_path.hpp"
#include "bench/world/motion/oscillation.hpp"

namespace canhil::world {
namespace {

template <class Own>
concept HasKinematics = requires(const Own& motion) {
  kinematics(motion, 0.0);
};

}  // namespace

Movement movement(const Motion& motion, double t) {
  return std::visit(
      [t](const auto& own) -> Movement {
        if constexpr (HasKinematics<std::remove_cvref_t<decltype(own)>>) {
          const Kinematics now = kinematics(own, t);
          return {.v_eb_n = now.v_eb_n,
                  .v_eb_n_rate = now.v_eb_n_rate,
                  .C_bn = C_bn_from(now.angles),
                  .omega_nb_b = omega_nb_b(now.angles, now.rates)};
        } else {
          return movement(own, t);
        }
      },
      motion);
}

Vector3 velocity(const Motion& motion, double t) {
  return std::visit(
      [t](const auto& own) -> Vector3 {
        if constexpr (HasKinematics<std::remove_cvref_t<decltype(own)>>) {
          return kinematics(own, t).v_eb_n;
        } else {
          return velocity(own, t);
        }
      },
      motion);
}

std::vector<std::int64_t> jumps_us(const Motion& motion, std::int64_t from_us, std::int64_t to_us) {
  if (const auto* recorded = std::get_if<Recorded>(&motion))
    return recorded->path->samples_between(from_us, to_us);
  if (const auto* grown = std::get_if<Grown>(&motion)) return grown->path->points_between(from_us, to_us);
  if (const auto* oscillating = std::get_if<Oscillating>(&motion))
    return oscillating->motion->jumps_us(from_us, to_us);
  if (const auto* legs = std::get_if<Legs>(&motion)) {
    const auto all = legs->path->jumps_us();
    const auto first = std::ranges::upper_bound(all, from_us);
    return {first, std::lower_bound(first, all.end(), to_us)};
  }
  const auto* flight = std::get_if<LevelAcceleration>(&motion);
  if (flight != nullptr && flight->cruise_us > from_us && flight->cruise_us < to_us)
    return {flight->cruise_us};
  return {};
}

}  // namespace canhil::world
