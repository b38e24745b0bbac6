// Random bit errors on a simulated wire.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "dbc/ports/simulated_wire.hpp"

namespace canhil {

/// Disturbs every bit on the wire with the same probability p, each by itself: a frame of n bits is hit with
/// 1 - (1 - p)^n, and what counts is its first disturbed bit. All nodes see it: the sender that it did not
/// read what it sent, the receivers by the sender's error flag, so two flags follow one another. Same seed,
/// same errors, on every machine: by number of the attempt.
class BitErrors {
 public:
  BitErrors(double rate, const wire::BitRates& rates, std::uint64_t seed)
      : rate_(rate), rates_(rates), engine_(seed) {}

  std::optional<WireError> operator()(const Attempt& attempt);

 private:
  double rate_;
  wire::BitRates rates_;
  std::mt19937_64 engine_;
};

}  // namespace canhil
