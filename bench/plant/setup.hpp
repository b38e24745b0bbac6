// The table [plant] of a scenario: a plant, what steers it, and what of it moves the carrier.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/plant/plant.hpp"
#include "bench/scenario/expression.hpp"
#include "bench/scenario/plant_facts.hpp"

namespace canhil::scenario {
struct Binding;
}

namespace canhil::plant {

/// What steers an input.
struct Command {
  std::size_t input = 0;      ///< index in Plan::inputs
  std::string from;           ///< a quantity or a flag that the target reports
  std::int64_t delay_us = 0;  ///< from the arrival of a command to its effect
  /// Without a new command for this time, the input takes `after_timeout`; none: it keeps its value.
  std::optional<std::int64_t> timeout_us{};
  std::optional<double> after_timeout{};  ///< in SI; none: it keeps its value
};

/// The values of the motion of a carrier: their names as true values.
inline constexpr std::array<std::string_view, 6> motion_values{"attitude.roll",    "attitude.pitch",
                                                               "attitude.heading", "velocity.north",
                                                               "velocity.east",    "velocity.down"};

struct Setup {
  std::string kind;  ///< Kind::key
  std::shared_ptr<const Plan> plan;
  std::vector<double> start;  ///< for each input: its value before the first command
  std::vector<Command> commands;
  /// Whether an output with the name of a true value is this value. Otherwise, and with other names, it is
  /// the true value "plant.NAME".
  bool shows_truths = false;
  /// For each of motion_values: an expression over the outputs; none: zero.
  std::array<std::optional<scenario::Expression>, motion_values.size()> motion{};

  [[nodiscard]] bool moves_the_carrier() const;
  /// The name of an output as a true value: "plant.rudder".
  [[nodiscard]] std::string shown(const Variable& output) const;
  /// Whether the plant has this output; `name`: as a true value.
  [[nodiscard]] bool shows(std::string_view name) const;
};

/// What a scenario knows of a plant.
scenario::PlantFacts facts_of(Setup setup);
/// What a scenario knows of a plant with tables of its own.
scenario::PlantFacts facts_of(const scenario::PlantTable& table, std::shared_ptr<const Plan> plan);

/// Reads the table [plant]. Errors are reported to the section; then there is no setup.
scenario::PlantFacts read_setup(scenario::Section& section, const scenario::Binding& binding);

}  // namespace canhil::plant
