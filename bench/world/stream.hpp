// Random numbers. Every consumer has its own stream, determined by (seed, run, name) alone. So results depend
// neither on the order of consumers nor on threads, and a new consumer does not change the numbers of the
// others.
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cstdint>
#include <string_view>

#include "bench/world/attitude.hpp"

namespace canhil::world {

class Stream {
 public:
  Stream(std::uint64_t seed, std::uint64_t run, std::string_view name);

  /// Next standard normal number.
  double normal() { return normal_(engine_); }
  /// Next three standard normal numbers.
  Vector3 normal3();
  /// Next number uniform in [0, 1).
  double uniform();

 private:
  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_;
};

/// A constant drawn for each run: value + sigma * N(0, 1).
struct RandomValue {
  double value = 0;
  double sigma = 0;
};

/// Draws the value. Takes one number from the stream, whatever sigma is.
inline double draw(const RandomValue& value, Stream& stream) {
  return value.value + value.sigma * stream.normal();
}

/// A constant that is drawn for each run: value + sigma * N(0, 1). Each axis has its own random number. If
/// sigma is 0, the constant is exactly `value`.
struct RandomConstant {
  Vector3 value = Vector3::Zero();
  Vector3 sigma = Vector3::Zero();
};

/// Draws the constant. Takes three numbers from the stream, whatever sigma is.
Vector3 draw(const RandomConstant& constant, Stream& stream);

}  // namespace canhil::world
