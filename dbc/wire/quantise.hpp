// Converts physical values to raw values and back. The generated codec and the run-time codec call the same
// functions, so both codecs produce the same bits.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace canhil::wire {

/// The physical value: raw * scale + offset. An offset of 0 is not added.
constexpr double physical(double raw, double scale, double offset) {
  const double scaled = raw * scale;
  return offset == 0 ? scaled : scaled + offset;
}

/// The nearest integer; halves are rounded to even. |x| must be below 2^63.
inline constexpr std::int64_t round_half_even(double x) {
  // std::lrint() uses the rounding mode of the host, which is never changed.
  if (!std::is_constant_evaluated()) return std::lrint(x);
  const auto down =
      static_cast<std::int64_t>(x) - (x < static_cast<double>(static_cast<std::int64_t>(x)) ? 1 : 0);
  const double rest = x - static_cast<double>(down);
  return rest > 0.5 || (rest == 0.5 && down % 2 != 0) ? down + 1 : down;
}

/// Converts a limit of a raw integer to double. Beyond 2^53, returns the next double towards zero, so that
/// the result is inside the range.
constexpr double bound(std::uint64_t raw) {
  if (raw >> 53U == 0) return static_cast<double>(raw);
  const int spare = 64 - 53 - __builtin_clzll(raw);
  return static_cast<double>((raw >> spare) << spare);
}
/// Converts a limit of a signed raw integer to double. Rounds towards zero, like the function for unsigned
/// limits.
constexpr double bound(std::int64_t raw) {
  const auto bits = static_cast<std::uint64_t>(raw);
  return raw < 0 ? -bound(0 - bits) : bound(bits);
}

/// Clamps x to [low, high]; NaN becomes low. With this order of the comparisons, the compiler generates
/// minsd, whose result for NaN is NaN, and then maxsd, which replaces NaN by low.
constexpr double clamped(double x, double low, double high) {
  const double at_most = high < x ? high : x;
  return at_most > low ? at_most : low;
}
/// Like clamped(), but NaN becomes high. Used for a negative scale, for which high is the physical minimum.
constexpr double clamped_nan_high(double x, double low, double high) {
  const double at_least = low > x ? low : x;
  return at_least < high ? at_least : high;
}

/// Converts a physical value to a raw value that is not rounded yet. The raw value is clamped to [low, high];
/// NaN becomes the physical minimum.
constexpr double unrounded(double value, double scale, double offset, double low, double high) {
  const double raw = (offset == 0 ? value : value - offset) / scale;
  return scale > 0 ? clamped(raw, low, high) : clamped_nan_high(raw, low, high);
}

/// Converts a physical value to raw bits, for a signed signal or for an unsigned signal of at most 63 bits.
/// The raw value is rounded half to even and saturated to [low, high].
constexpr std::uint64_t quantised(double value, double scale, double offset, double low, double high) {
  return static_cast<std::uint64_t>(round_half_even(unrounded(value, scale, offset, low, high)));
}

/// Converts a physical value to raw bits, for an unsigned signal of 64 bits. The raw value is rounded half to
/// even and saturated to [low, high].
constexpr std::uint64_t quantised_wide(double value, double scale, double offset, double low, double high) {
  constexpr double half = 9223372036854775808.0;
  const double raw = unrounded(value, scale, offset, low, high);
  if (raw < half) return static_cast<std::uint64_t>(round_half_even(raw));
  return static_cast<std::uint64_t>(raw);  // doubles of this size are whole numbers
}

/// Converts a physical value to raw bits, for a float signal. The raw value is saturated to [low, high].
template <class Float>
constexpr std::uint64_t float_bits(double value, double scale, double offset, double low, double high) {
  const auto raw = static_cast<Float>(unrounded(value, scale, offset, low, high));
  if constexpr (sizeof(Float) == 4) {
    return std::bit_cast<std::uint32_t>(raw);
  } else {
    return std::bit_cast<std::uint64_t>(raw);
  }
}

/// Converts the raw bits of a float signal to a float or double.
template <class Float>
constexpr Float real(std::uint64_t bits) {
  if constexpr (sizeof(Float) == 4) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  } else {
    return std::bit_cast<double>(bits);
  }
}

/// Clamps an integer to [low, high].
template <class Integer>
constexpr std::uint64_t saturated(Integer value, Integer low, Integer high) {
  return static_cast<std::uint64_t>(value < low ? low : value > high ? high : value);
}

}  // namespace canhil::wire
