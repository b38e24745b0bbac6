// Numbers in a scenario file: the unit from a key's suffix, and limits of the value in that unit.
#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace canhil::scenario {

/// The factor from the unit in a key's suffix (heading_deg) to SI and radians; 1 for SI units and plain
/// numbers.
double factor_of(std::string_view key);

/// The suffix of a key that is its unit, "_deg"; empty: the key has no unit.
std::string_view ending_of(std::string_view key);

/// The unit in a key's suffix, as people write it; empty: the key has no unit.
std::string_view unit_of(std::string_view key);

/// The limits of a number, in the unit of its key.
struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false;  ///< `least` itself is excluded

  static Limits between(double least, double most) { return {least, most, false}; }
  static Limits at_least(double least) { return {.least = least}; }
  static Limits above(double bound, double most = std::numeric_limits<double>::infinity()) {
    return {bound, most, true};
  }
};

/// The ending of keys for values with this SI unit: "_deg" for rad; empty: none for it.
std::string_view ending_for(std::string_view si);

/// Whether a value is finite and within limits.
bool holds(const Limits& limits, double value);

/// Limits as text after a noun: "a number from 0 to 90".
std::string description(const Limits& limits, std::string_view noun);

}  // namespace canhil::scenario
