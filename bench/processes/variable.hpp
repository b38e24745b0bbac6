// A number that the bench and a program of the user exchange.
#pragma once

#include <string>

namespace canhil::processes {

/// An input or an output. All values are in SI.
struct Variable {
  std::string name;    ///< "rudder"
  std::string si{};    ///< SI unit; empty: a plain number
  bool turns = false;  ///< an angle: values that differ by a full turn are equal
  bool steps =
      false;         ///< changes only in steps: an integer, a switch. No value lies between two of its values
  double start = 0;  ///< of an input: its value before the first command
  friend bool operator==(const Variable&, const Variable&) = default;
};

}  // namespace canhil::processes
