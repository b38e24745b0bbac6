// Random bit errors on a simulated wire.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "dbc/ports/simulated_wire.hpp"

namespace canhil {

/// Disturbs every bit on the wire independently with probability p: an error hits a frame of n bits with
/// probability 1 - (1 - p)^n, at the first disturbed bit. All nodes notice it: the sender reads another bit
/// than it sent, the receivers see the sender's error flag, so two flags follow one another. Errors depend
/// only on the seed and the number of the attempt, on every machine.
class BitErrors {
 public:
  /// `rate`: probability of an error per bit; `rates`: of the wire.
  BitErrors(double rate, const wire::BitRates& rates, std::uint64_t seed)
      : rate_(rate), rates_(rates), engine_(seed) {}

  /// The error that hits this attempt, if any.
  std::optional<WireError> operator()(const Attempt& attempt);

 private:
  double rate_;
  wire::BitRates rates_;
  std::mt19937_64 engine_;
};

}  // namespace canhil
