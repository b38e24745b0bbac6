// Rounding of increments onto the bus: what a sample loses, the next one carries, so that nothing
// accumulates.
#pragma once

#include <algorithm>
#include <cmath>

#include "bench/world/attitude.hpp"
#include "dbc/wire/message_info.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::nodes {

/// Rounds a triad of increments to the resolution and range of a signal, keeping the remainders. Without
/// rounding only what the range cuts off remains.
class IncrementRounding {
 public:
  explicit IncrementRounding(const SignalInfo& signal)
      : lsb_(wire::lsb(signal)), minimum_(signal.minimum), maximum_(signal.maximum) {}

  /// sent = round(increment + remainder); remainder' = increment + remainder - sent. Unit of the signal.
  world::Vector3 round(const world::Vector3& increment, Rounding rounding) {
    const double step = rounding == Rounding::none ? 0 : lsb_;
    const world::Vector3 wanted = increment + remainder_;
    world::Vector3 sent =
        wanted.unaryExpr([&](double x) { return std::clamp(nearest(x, step), minimum_, maximum_); });
    remainder_ = wanted - sent;
    return sent;
  }

 private:
  static double nearest(double x, double step) { return step == 0 ? x : std::nearbyint(x / step) * step; }

  double lsb_;
  double minimum_;
  double maximum_;
  world::Vector3 remainder_ = world::Vector3::Zero();
};

}  // namespace canhil::nodes
