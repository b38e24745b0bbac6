// The sum of white noise and a first-order Gauss-Markov process: sensor errors that are partly correlated in
// time.
#pragma once

#include "bench/world/stream.hpp"

namespace canhil::world {

/// Three components, each standard normal at every instant; `fraction` of the variance is correlated in time.
class CorrelatedNoise {
 public:
  /// correlation_time [s]. The process starts in its steady state.
  CorrelatedNoise(double fraction, double correlation_time, Stream& stream);

  /// The noise at the time dt [s] after the previous call. Every call takes six numbers from the stream,
  /// whatever the fraction is.
  Vector3 next(double dt, Stream& stream);

 private:
  double fraction_;
  double correlation_time_;
  Vector3 correlated_;
};

}  // namespace canhil::world
