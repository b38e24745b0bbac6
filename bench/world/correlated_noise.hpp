// The sum of white noise and a first-order Gauss-Markov process: sensor errors that are partly correlated in
// time.
#pragma once

#include "bench/world/gauss_markov.hpp"
#include "bench/world/stream.hpp"

namespace canhil::world {

/// Three components, each standard normal at every instant; `fraction` of the variance is correlated in time.
class CorrelatedNoise {
 public:
  /// correlation_time, and the time dt from one call of next() to the next [s]. The process starts in its
  /// steady state.
  CorrelatedNoise(double fraction, double correlation_time, double dt, Stream& stream);

  /// The next noise. Every call takes six numbers from the stream, whatever the fraction is.
  Vector3 next(Stream& stream);

 private:
  double fraction_;
  GaussMarkov process_;
  Vector3 correlated_;
};

}  // namespace canhil::world
