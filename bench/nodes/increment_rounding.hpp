// Rounding of increments to the resolution of the bus: the remainder of a sample is added to the next sample,
// so rounding errors do not accumulate.
#pragma once

#include <algorithm>
#include <cmath>

#include "dbc/wire/message_info.hpp"

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

}  // namespace canhil::nodes
