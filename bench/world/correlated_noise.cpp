#include "bench/world/correlated_noise.hpp"

#include <cmath>

namespace canhil::world {

CorrelatedNoise::CorrelatedNoise(double fraction, double correlation_time, Stream& stream)
    : fraction_(fraction), correlation_time_(correlation_time), correlated_(stream.normal3()) {}

Vector3 CorrelatedNoise::next(double dt, Stream& stream) {
  const double kept = std::exp(-dt / correlation_time_);
  correlated_ = kept * correlated_ + std::sqrt(1 - kept * kept) * stream.normal3();
  return std::sqrt(fraction_) * correlated_ + std::sqrt(1 - fraction_) * stream.normal3();
}

}  // namespace canhil::world
