// A quantity: a named scalar with a unit and a time of validity. The bench judges, plots, stores and exports
// series of quantities, whichever estimator reports them.
#pragma once

#include <span>
#include <string_view>

namespace canhil::quantities {

/// The unit in which reports show a quantity.
struct Unit {
  std::string_view name{};    ///< "mrad", "m/s", "m", or empty
  std::string_view ending{};  ///< suffix of keys: "_mrad", "_mps", "_m", or empty
  double factor = 1;          ///< to SI
};

/// The name of the SI unit, which files use: "rad", "rad/s", "m/s", "m", or empty.
constexpr std::string_view si_name(const Unit& unit) {
  if (unit.factor == 1) return unit.name;
  return unit.name.ends_with("/s") ? "rad/s" : "rad";
}

/// A quantity. Each quantity is a single object, identified by its address. Values are in SI.
struct Quantity {
  std::string_view name;       ///< "attitude.heading"
  std::string_view meaning;    ///< for people, without a full stop
  Unit unit{};                 ///< for reports
  int degrees_of_freedom = 0;  ///< of a normalised error squared; 0 for all other quantities
  bool white = false;          ///< an innovation or its square: successive values are independent
  bool nan_allowed = false;    ///< NaN is not an error: it means that the sample has no such value
  bool of_whole_run = false;   ///< the same value in all samples of a run; never becomes stale
  std::string_view once{};     ///< its former name in files; empty: none
  /// The components, each with its own track; empty: the quantity is not divided and has one track.
  std::span<const Quantity* const> parts{};
};

}  // namespace canhil::quantities
