#include "dbc/ports/bit_errors.hpp"

#include <algorithm>

namespace canhil {
namespace {

using wire::intermission_bits;

constexpr int two_flags_bits = 12;

/// The time from the start of a frame to the end of its bit number `bit`, counted from 0.
std::int64_t end_of_bit_ns(std::int64_t bit, const wire::BitLength& length, const wire::BitRates& rates) {
  const std::int64_t before_data = length.data > 0 ? length.nominal - wire::frame_end_bits : length.nominal;
  const std::int64_t data = std::clamp<std::int64_t>(bit + 1 - before_data, 0, length.data);
  return wire::duration_ns({.nominal = bit + 1 - data, .data = data}, rates);
}

}  // namespace

std::optional<WireError> BitErrors::operator()(const Attempt& attempt) {
  const wire::BitLength length = wire::bit_length(attempt.frame);
  const std::int64_t bits = length.bits() - intermission_bits;
  const double u = static_cast<double>(engine_() >> 11U) * 0x1p-53;  // random, uniform in [0, 1)
  double clean = 1;  // probability that the bits 0..bit have no error: (1 - p)^(bit + 1)
  for (std::int64_t bit = 0; bit < bits; ++bit) {
    clean *= 1 - rate_;
    if (u >= clean)
      return WireError{.after_ns = end_of_bit_ns(bit, length, rates_), .flag_bits = two_flags_bits};
  }
  return std::nullopt;
}

}  // namespace canhil
