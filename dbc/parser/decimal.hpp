// Physical values as decimal numbers, for output. A DBC gives scale and offset as decimal numbers, but a
// double holds only the nearest binary number: with doubles, 3 * 0.1 is 0.30000000000000004. Here the value
// is computed with the decimal numbers themselves.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// The number digits * 10^exponent.
struct Decimal {
  RawNumber digits = 0;
  int exponent = 0;
};

/// The shortest decimal number that reads back as `value`; `value` must be finite.
Decimal shortest_decimal(double value);

/// Converts raw bits of a signal to text.
class DecimalConversion {
 public:
  /// The conversion of a signal.
  explicit DecimalConversion(const Signal& signal);

  /// The physical value raw * scale + offset, in the unit of the signal. `raw` are right-aligned bits. An
  /// integer has all its digits. Any other number is the shortest text that reads back as the double nearest
  /// to the exact value (of a float signal: to the value in extended precision). A float signal may also be
  /// "nan", "inf" or "-inf".
  [[nodiscard]] std::string text(std::uint64_t raw) const;

 private:
  [[nodiscard]] std::string of_integer(RawNumber raw) const;
  [[nodiscard]] std::string of_float(double raw) const;
  [[nodiscard]] double nearest(long double raw) const;

  RawType type_;
  unsigned length_;
  Decimal scale_, offset_;  // with the same exponent, which is at most 0
  bool is_exact_ = true;    // false: the exact value could need more than 127 bits
  bool is_plain_;           // the scale is 1 and the offset is 0
  long double long_scale_, long_offset_;
};

}  // namespace canhil::dbc
