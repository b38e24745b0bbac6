// The true values that can be named: what sensors measure, targets estimate and expressions use.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "bench/world/plant_record.hpp"

namespace canhil::world {

class FlightRecord;

/// The truths of a run.
struct Truths {
  const FlightRecord& flight;
  PlantRecords plants{};
};

/// The truth that contains a value. `motion`: a plant that shows the value itself, otherwise the flight.
enum class TruthIn : std::uint8_t { flight, motion, plant };

/// A true value, in SI. Axes: north, east, down, or those of the body (forward, right, down).
struct TruthValue {
  std::string_view name;  ///< "attitude.heading"
  std::string_view si;    ///< SI unit
  bool turns = false;     ///< an angle: values that differ by a full turn are equal
  TruthIn in = TruthIn::flight;
  /// Null: an output of a plant.
  std::optional<double> (*of)(const Truths& truths, std::int64_t t_us) = nullptr;

  /// The value at a time [us] of the run; none: there is no truth at this time.
  [[nodiscard]] std::optional<double> at(const Truths& truths, std::int64_t t_us) const;
};

std::span<const TruthValue> truth_values();
/// The value of this name; null: there is none. Any name that begins with plant_prefix may be an output of a
/// plant: the scenario says whether its plant has it.
const TruthValue* find_truth_value(std::string_view name);
inline constexpr std::string_view plant_prefix = "plant.";

}  // namespace canhil::world
