// Rounding of increments to the resolution of the bus: the remainder of a sample is added to the next sample,
// so rounding errors do not accumulate.
#pragma once

#include <algorithm>
#include <cmath>

#include "bench/world/attitude.hpp"
#include "dbc/wire/message_info.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::nodes {

/// Rounds the sum of `increment` and `remainder` to steps of `lsb` (0: no rounding), limits the result to the
/// range of the signal, and returns it. Stores the difference between the sum and the result in `remainder`.
/// All values are in the unit of the signal.
inline double round_increment(double increment, double lsb, const SignalInfo& signal, double& remainder) {
  const double wanted = increment + remainder;
  const double near = lsb == 0 ? wanted : std::nearbyint(wanted / lsb) * lsb;
  const double sent = std::clamp(near, signal.minimum, signal.maximum);
  remainder = wanted - sent;
  return sent;
}

/// Rounds three increments to the resolution and the range of a signal, and keeps the remainder of each axis
/// for the next call. Without rounding, a remainder is only the part of the value beyond the range.
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
