#include "dbc/parser/decimal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "dbc/wire/quantise.hpp"

namespace canhil::dbc {
namespace {

/// Changes the exponent to a lower one, which does not change the number. False: the digits do not fit.
bool lower_exponent(Decimal& decimal, int exponent) {
  for (; decimal.exponent > exponent; --decimal.exponent) {
    if (decimal.digits == 0) {
      decimal.exponent = exponent;
      return true;
    }
    if (__builtin_mul_overflow(decimal.digits, 10, &decimal.digits)) return false;
  }
  return true;
}

double nearest_double(const Decimal& decimal) {
  constexpr RawNumber exact_double = RawNumber{1} << 53U;
  constexpr std::array powers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                              1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const auto power = static_cast<std::size_t>(-decimal.exponent);
  // Both numbers are exact, so the division is the only operation that rounds.
  if (decimal.digits < exact_double && decimal.digits > -exact_double && power < powers.size())
    return static_cast<double>(decimal.digits) / powers[power];
  const std::string text = fmt::format("{}e{}", decimal.digits, decimal.exponent);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// The integer that the number is; false: it is not an integer.
bool to_integer(const Decimal& decimal, RawNumber& integer) {
  integer = decimal.digits;
  for (int exponent = decimal.exponent; exponent < 0; ++exponent) {
    if (integer % 10 != 0) return false;
    integer /= 10;
  }
  return true;
}

long double read_long_double(double value) { return std::strtold(fmt::format("{}", value).c_str(), nullptr); }

}  // namespace

Decimal shortest_decimal(double value) {
  Decimal decimal;
  const std::string text = fmt::format("{}", value);
  bool is_fraction = false;
  std::size_t i = text.starts_with('-') ? 1 : 0;
  for (; i < text.size() && text[i] != 'e'; ++i) {
    if (text[i] == '.') {
      is_fraction = true;
    } else {
      decimal.digits = decimal.digits * 10 + (text[i] - '0');
      decimal.exponent -= is_fraction ? 1 : 0;
    }
  }
  if (i < text.size()) decimal.exponent += std::atoi(text.c_str() + i + 1);
  while (decimal.digits != 0 && decimal.digits % 10 == 0) {
    decimal.digits /= 10;
    ++decimal.exponent;
  }
  if (text.starts_with('-')) decimal.digits = -decimal.digits;
  return decimal;
}

DecimalConversion::DecimalConversion(const Signal& signal)
    : type_(signal.type),
      length_(signal.length),
      scale_(shortest_decimal(signal.scale)),
      offset_(shortest_decimal(signal.offset)),
      is_plain_(signal.scale == 1 && signal.offset == 0),
      long_scale_(read_long_double(signal.scale)),
      long_offset_(read_long_double(signal.offset)) {
  const int exponent = std::min({scale_.exponent, offset_.digits == 0 ? 0 : offset_.exponent, 0});
  is_exact_ = lower_exponent(scale_, exponent) && lower_exponent(offset_, exponent);
  // raw * scale + offset has at most one bit more than the longer of the product and the offset.
  const RawNumber largest_raw = RawNumber{1} << length_;
  RawNumber largest = 0;
  is_exact_ = is_exact_ && !__builtin_mul_overflow(scale_.digits, largest_raw, &largest) &&
              !__builtin_add_overflow(largest < 0 ? -largest : largest,
                                      offset_.digits < 0 ? -offset_.digits : offset_.digits, &largest);
}

std::string DecimalConversion::text(std::uint64_t raw) const {
  switch (type_) {
    case RawType::float32:
      return of_float(static_cast<double>(wire::real<float>(raw)));
    case RawType::float64:
      return of_float(wire::real<double>(raw));
    case RawType::signed_integer: {
      const std::uint64_t sign = std::uint64_t{1} << (length_ - 1);
      return of_integer(static_cast<std::int64_t>((raw ^ sign) - sign));
    }
    case RawType::unsigned_integer:
      break;
  }
  return of_integer(raw);
}

std::string DecimalConversion::of_integer(RawNumber raw) const {
  if (!is_exact_) return fmt::format("{}", nearest(static_cast<long double>(raw)));
  const Decimal value{raw * scale_.digits + offset_.digits, scale_.exponent};
  RawNumber integer = 0;
  return to_integer(value, integer) ? fmt::format("{}", integer) : fmt::format("{}", nearest_double(value));
}

std::string DecimalConversion::of_float(double raw) const {
  if (std::isnan(raw)) return "nan";
  return fmt::format("{}", is_plain_ ? raw : nearest(static_cast<long double>(raw)));
}

double DecimalConversion::nearest(long double raw) const {
  return static_cast<double>(raw * long_scale_ + long_offset_);
}

}  // namespace canhil::dbc
