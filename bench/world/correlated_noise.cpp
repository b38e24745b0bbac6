#include "bench/world/correlated_noise.hpp"

#include <cmath>

namespace canhil::world {

CorrelatedNoise::CorrelatedNoise(double fraction, double correlation_time, double dt, Stream& stream)
    : fraction_(fraction), process_(dt / correlation_time), correlated_(stream.normal3()) {}

Vector3 CorrelatedNoise::next(Stream& stream) {
  correlated_ = process_.next(correlated_, stream.normal3());
  return std::sqrt(fraction_) * correlated_ + std::sqrt(1 - fraction_) * stream.normal3();
}

}  // namespace canhil::world
