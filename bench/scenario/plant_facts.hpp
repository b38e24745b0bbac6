// What the rest of a scenario knows of its plants (bench/plant reads them).
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace canhil::plant {
struct Setup;
}

namespace canhil::scenario {

struct Binding;
struct PlantTable;
class Section;

/// Errors of the state that the target receives when a plant begins to move: 1-sigma of each component.
struct ReleaseError {
  double air_velocity = 0;  ///< body [m/s]
  double velocity = 0;      ///< NED [m/s]
  double attitude = 0;      ///< roll, pitch, heading [rad]
  double rate = 0;          ///< body [rad/s]
};

/// How the target's answers to a sensor's samples guide what moves.
struct Guidance {
  std::int64_t delay_us = 0;  ///< from sending a sample to the command that uses its answer
  bool predicts = false;      ///< extrapolates the answer to the time of the command
};

struct PlantFacts {
  struct Output {
    std::string name;    ///< as a true value: "plant.rudder"
    std::string si;      ///< SI unit; empty: a plain number
    bool turns = false;  ///< an angle: values that differ by a full turn are equal
  };
  std::shared_ptr<const plant::Setup> setup{};  ///< null: the scenario has no plant
  std::vector<Output> outputs{};
  std::vector<std::string> steered{};  ///< the inputs that the target commands
  bool moves_the_carrier = false;
  const PlantTable* table = nullptr;  ///< its own tables; null: [plant]
  ReleaseError release{};
  std::optional<Guidance> guidance{};  ///< none: the target does not guide it
  double to_go_s = 0;                  ///< time until its own end, at the start; 0: it has none
  double largest_roll_rate = 0;        ///< of the antenna, apart from what the servo does [rad/s]

  /// Whether it has an output with this name as a true value.
  [[nodiscard]] bool shows(std::string_view name) const {
    return std::ranges::find(outputs, name, &Output::name) != outputs.end();
  }
};

/// A plant that a scenario describes in tables of its own instead of [plant].
struct PlantTable {
  std::string_view key;                                ///< its table
  std::span<const std::string_view> further_tables{};  ///< further tables about it
  std::string_view about;                              ///< for the reference
  /// Outputs that only this plant has: nodes and estimators name one of them (NodeTable::samples).
  std::span<const std::string_view> shows;
  std::int64_t sampled_every_us = 1;  ///< the periods of its sensors are multiples of this time
  bool nodes_last = false;            ///< its nodes transmit after those of the carrier
  /// `root`: the whole file; `table`: the table `key`. Errors are reported to the sections.
  PlantFacts (*read)(Section& root, Section& table, const Binding& binding) = nullptr;

  [[nodiscard]] bool has(std::string_view output) const {
    return std::ranges::find(shows, output) != shows.end();
  }
};

}  // namespace canhil::scenario
