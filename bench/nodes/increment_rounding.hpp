// Rounding of increments to the resolution of the bus: the remainder of a sample is carried into the next
// one, so rounding errors do not accumulate.
#pragma once

#include <algorithm>
#include <cmath>

#include "bench/world/attitude.hpp"
#include "dbc/wire/message_info.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::nodes {

/// Rounds a scalar to steps of `lsb` (0: no rounding), limits it to the signal's range and keeps the
/// remainder: sent = round(increment + remainder); remainder' = increment + remainder - sent. All
/// values are in the signal's unit.
inline double round_increment(double increment, double lsb, const SignalInfo& signal, double& remainder) {
  const double wanted = increment + remainder;
  const double near = lsb == 0 ? wanted : std::nearbyint(wanted / lsb) * lsb;
  const double sent = std::clamp(near, signal.minimum, signal.maximum);
  remainder = wanted - sent;
  return sent;
}

/// Rounds a triad of increments to the resolution and range of a signal and carries the remainders. Without
/// rounding, the remainder is only the part beyond the range.
class IncrementRounding {
 public:
  explicit IncrementRounding(const SignalInfo& signal) : signal_(signal) {}

  /// Applies round_increment() to each axis.
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
