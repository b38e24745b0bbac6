// A built-in motion with oscillations on top of it: vibration and the waves of the sea (oscillation.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/world/kinematics.hpp"

namespace canhil::world {

class Oscillation;

struct Oscillating {
  std::shared_ptr<const Oscillation> motion;
};

Movement movement(const Oscillating& motion, double t);
Vector3 velocity(const Oscillating& motion, double t);

}  // namespace canhil::world
