// A quantity: a named scalar with a unit and a time of validity. The bench judges, plots, stores and exports
// series of quantities in the same way for all estimators.
#pragma once

#include <span>
#include <string_view>

namespace canhil::quantities {

/// The unit in which reports show a quantity.
struct Unit {
  std::string_view name{};    ///< "mrad", "m/s", "m", or empty
  std::string_view ending{};  ///< suffix of keys in reports: "_mrad", "_mps", "_m", or empty
  double factor = 1;          ///< value in SI = value in this unit * factor
};

/// The name of the corresponding SI unit: "rad", "rad/s", "m/s", "m", or empty. Files contain values in SI
/// units.
constexpr std::string_view si_name(const Unit& unit) {
  if (unit.factor == 1) return unit.name;
  return unit.name.ends_with("/s") ? "rad/s" : "rad";
}

/// A quantity. There is one object for each quantity, and its address identifies the quantity. The values of
/// a quantity are in SI.
struct Quantity {
  std::string_view name;        ///< "attitude.heading"
  std::string_view meaning;     ///< description for people, without a full stop
  Unit unit{};                  ///< the unit in reports
  int degrees_of_freedom = 0;   ///< if the quantity is a normalised error squared; otherwise 0
  bool white = false;           ///< true for an innovation or its square: successive values are independent
  bool nan_allowed = false;     ///< true: a value may be NaN, which means that the sample has no such value
  bool of_whole_run = false;    ///< true: all samples of a run have the same value, which never becomes stale
  bool has_time_to_go = false;  ///< true: its values belong to samples of a seeker, which have a time to go
  /// The components of the quantity; each component has its own track. Empty: the quantity has no components,
  /// and has one track.
  std::span<const Quantity* const> parts{};
  /// For a quantity that is 0 where an answer says that it is not to be trusted: the same of every answer.
  const Quantity* of_every_answer = nullptr;
};

}  // namespace canhil::quantities
