// The motions that a truth may follow. A new motion needs a struct in motion/ and a name in this variant.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "bench/world/earth.hpp"
#include "bench/world/motion/along_the_nose.hpp"
#include "bench/world/motion/grown.hpp"
#include "bench/world/motion/legs.hpp"
#include "bench/world/motion/level_acceleration.hpp"
#include "bench/world/motion/oscillating.hpp"
#include "bench/world/motion/recorded.hpp"
#include "bench/world/motion/rest.hpp"
#include "bench/world/motion/unknown.hpp"
#include "bench/world/motion/weave.hpp"

namespace canhil::world {

template <class... More>
using MotionOr =
    std::variant<Rest, LevelAcceleration, Weave, SPath, Racetrack, Spiral, RestThenGo, Legs, More...>;

/// A motion that has Kinematics, so that oscillations can be added.
using BuiltInMotion = MotionOr<>;
using Motion = MotionOr<Oscillating, Recorded, Grown, Unknown>;

/// Velocity and attitude at time t [s] from the start; right-continuous where the motion has a jump.
Movement movement(const Motion& motion, double t);
/// The velocity alone [m/s].
Vector3 velocity(const Motion& motion, double t);

/// The times [us] in ascending order at which an acceleration, a rate or one of their derivatives is
/// discontinuous, between `from_us` and `to_us`, ends excluded. Quadrature must not step across these times.
std::vector<std::int64_t> jumps_us(const Motion& motion, std::int64_t from_us, std::int64_t to_us);

struct OscillationModel;

/// A complete truth: initial position and motion.
struct Flight {
  Position start;
  Motion motion;
  /// The oscillations that are yet to be drawn and added (oscillation.hpp); null: none.
  std::shared_ptr<const OscillationModel> oscillations{};
};

}  // namespace canhil::world
