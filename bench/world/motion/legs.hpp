// A motion made of legs or of waypoints (leg_path.hpp).
#pragma once

#include <memory>

#include "bench/world/kinematics.hpp"

namespace canhil::world {

class LegPath;

struct Legs {
  std::shared_ptr<const LegPath> path;
};

Kinematics kinematics(const Legs& motion, double t);

}  // namespace canhil::world
