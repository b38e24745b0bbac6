// Random bit errors on a simulated wire.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "dbc/ports/simulated_wire.hpp"

namespace canhil {

/// Disturbs every bit on the wire with probability p, independently of the other bits. So the probability
/// that an error occurs in a frame of n bits is 1 - (1 - p)^n. The error occurs at the first disturbed bit of
/// the frame. All nodes detect the error: the sender reads a bit that differs from the bit that it sent, and
/// the receivers detect the error flag of the sender. Therefore two error flags follow one another. The
/// random number for an attempt to send a frame depends only on the seed and on the number of earlier
/// attempts on the wire. So the errors are the same on every machine.
class BitErrors {
 public:
  /// `rate` is the probability of an error per bit; `rates` are the bit rates of the wire.
  BitErrors(double rate, const wire::BitRates& rates, std::uint64_t seed)
      : rate_(rate), rates_(rates), engine_(seed) {}

  /// The error in this attempt to send a frame; nullopt: there is none.
  std::optional<WireError> operator()(const Attempt& attempt);

 private:
  double rate_;
  wire::BitRates rates_;
  std::mt19937_64 engine_;
};

}  // namespace canhil
