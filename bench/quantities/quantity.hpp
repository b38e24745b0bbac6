// A quantity: a named scalar with a unit and a time of validity. What the bench judges, plots, stores and
// exports are series of quantities; it knows no estimator by name.
#pragma once

#include <span>
#include <string_view>

namespace canhil::quantities {

/// What people read a quantity in.
struct Unit {
  std::string_view name{};    ///< "mrad", "m/s", "m", or empty
  std::string_view ending{};  ///< of keys: "_mrad", "_mps", "_m", or empty
  double factor = 1;          ///< to SI
};

/// The name of the SI unit, in which files are: "rad", "rad/s", "m/s", "m", or empty.
constexpr std::string_view si_name(const Unit& unit) {
  if (unit.factor == 1) return unit.name;
  return unit.name.ends_with("/s") ? "rad/s" : "rad";
}

/// One quantity; each is one object, and known by its address. Values are in SI.
struct Quantity {
  std::string_view name;       ///< "attitude.heading"
  std::string_view meaning;    ///< for people, without a full stop
  Unit unit{};                 ///< that reports use
  int degrees_of_freedom = 0;  ///< of a normalised error squared; 0: it is none
  bool white = false;          ///< an innovation, or its square: independent from one to the next
  bool nan_allowed = false;    ///< NaN tells of nothing wrong: the sample was not asked for it
  bool of_whole_run = false;   ///< the same in all samples: it does not age
  std::string_view once{};     ///< the name that it had in files before; empty: none
  /// It is these together, each with a track of its own; empty: itself.
  std::span<const Quantity* const> parts{};
};

}  // namespace canhil::quantities
