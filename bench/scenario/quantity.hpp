// Numbers of a scenario file: the unit that a key's name ends in, and the limits of its value in that unit.
#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace canhil::scenario {

/// The unit a key's name ends in (heading_deg), as a factor to SI and radians; 1 for SI units and plain
/// numbers.
double factor_of(std::string_view key);

/// The unit that a key's name ends in, as people write it; empty: a plain number.
std::string_view unit_of(std::string_view key);

/// What a number may be, in the unit of its key.
struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false;  ///< `least` itself is out

  static Limits between(double least, double most) { return {least, most, false}; }
  static Limits at_least(double least) { return {.least = least}; }
  static Limits above(double bound, double most = std::numeric_limits<double>::infinity()) {
    return {bound, most, true};
  }
};

/// Whether a value is finite and within limits.
bool holds(const Limits& limits, double value);

/// Limits in words, after a noun: "a number from 0 to 90".
std::string description(const Limits& limits, std::string_view noun);

}  // namespace canhil::scenario
