// Rounds the increments of three axes.
#pragma once

#include "bench/nodes/increment_rounding.hpp"
#include "bench/world/attitude.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::nodes {

class IncrementRounding {
 public:
  explicit IncrementRounding(const SignalInfo& signal) : signal_(signal) {}
  world::Vector3 round(const world::Vector3& increment, Rounding rounding) {
    const double lsb = rounding == Rounding::none ? 0 : wire::lsb(signal_);
    world::Vector3 sent;
    for (int axis = 0; axis < 3; ++axis)
      sent[axis] = round_increment(increment[axis], lsb, signal_, remainder_[axis]);
    return sent;
  }

 private:
  SignalInfo signal_;
  world::Vector3 remainder_ = world::Vector3::Zero();
};

}  // namespace canhil::nodes
