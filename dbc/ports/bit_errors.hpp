// Random bit errors on a simulated wire.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "dbc/ports/simulated_wire.hpp"

namespace canhil {

/// Disturbs every bit on the wire independently with probability p, so an error hits a frame of n bits with
/// probability 1 - (1 - p)^n, at its first disturbed bit. All nodes detect the error: the sender reads a bit
/// that differs from the one it sent, and the receivers see the error flag of the sender, so two error flags
/// follow one another. The random number of an attempt depends only on the seed and on the number of earlier
/// attempts on the wire, so the errors are the same on every machine.
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
