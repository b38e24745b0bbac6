// A scenario file, read and validated: one flight, the nodes on the bus, the target's initial state, and the
// criteria.
//
// Values in the file have the unit in their key (heading_deg); the structs use SI and radians, times in us.
// Each section of the file is a struct with its own reader; the readers of nodes are in bench/nodes, and the
// DbcVocabulary contains them. Reading is strict: an unknown key, a wrong type, a value out of range or a
// missing key is an error of one line, "file:line: key 'slave_imu.period_ms': what is wrong, expected what".
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/checks.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/events.hpp"
#include "bench/scenario/faults.hpp"
#include "bench/scenario/node.hpp"
#include "bench/scenario/node_program.hpp"
#include "bench/scenario/plant_facts.hpp"
#include "bench/scenario/setting.hpp"
#include "bench/scenario/target_setup.hpp"
#include "bench/world/motion.hpp"
#include "bench/world/navigation_errors.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::world {
struct TruthValue;
}

namespace canhil::scenario {

/// An input file of a scenario other than the scenario file.
struct InputFile {
  std::string role;  ///< "recording", "plant", "faults"
  std::string path;
};

struct Scenario {
  std::string file;  ///< as named by the user
  std::vector<InputFile> inputs{};
  std::vector<Setting> settings{};  ///< values that replaced those of the file
  std::uint64_t hash = 0;  ///< FNV-1a of text, settings and recordings: provenance in reports and campaigns
  std::uint64_t recordings_hash = 0;  ///< hash of the recordings alone; 0: no recordings
  std::string title;
  std::int64_t duration_us = 0;
  std::uint64_t seed = 0;
  std::optional<bool> fd;  ///< the selected DBC; true: canhil-fd, false: canhil, none: not selected

  std::shared_ptr<const Binding> binding;  ///< of the DBC of the bus
  std::vector<TargetSetup> targets;        ///< one for each estimator that the target runs
  world::Flight truth;                     ///< at rest if no estimator navigates
  world::InitialErrorModel
      initial_error;  ///< errors of the initial state for the target, relative to the truth at the start
  PlantFacts plant;   ///< the table [plant]
  std::vector<PlantFacts> of_tables;  ///< plants with tables of their own, in addition to `truth`
  std::vector<NodeSettings> nodes;    ///< the nodes on the bus
  std::vector<NodeProgram> programs;  ///< of the user, which are nodes of the bus
  std::vector<Event> events;
  std::vector<Fault> faults;
  std::vector<Check> checks;

  /// Whether what moves depends on the target's answers, so that no flight is known before its run.
  [[nodiscard]] bool closes_the_loop() const {
    return !plant.steered.empty() ||
           std::ranges::any_of(of_tables, [](const PlantFacts& one) { return one.guidance.has_value(); });
  }
  /// The plant with this output, a true value; null: no plant has it.
  [[nodiscard]] const PlantFacts* plant_with(std::string_view output) const {
    for (const PlantFacts& one : of_tables) {
      if (one.shows(output)) return &one;
    }
    return plant.shows(output) ? &plant : nullptr;
  }
  /// If false, answers cannot be compared with the flight of the carrier.
  [[nodiscard]] bool truth_is_known() const { return !std::holds_alternative<world::Unknown>(truth.motion); }
  [[nodiscard]] bool runs(std::string_view estimator) const {
    return std::ranges::find(targets, estimator, &TargetSetup::estimator) != targets.end();
  }
  /// The node with this table name; null: this node is not on the bus.
  [[nodiscard]] const NodeSettings* node(std::string_view key) const {
    const auto found = std::ranges::find(nodes, key, [](const NodeSettings& one) { return one.table().key; });
    return found == nodes.end() ? nullptr : &*found;
  }
};

/// Reads a scenario file. The error is one line.
Result<Scenario> read_file(const std::filesystem::path& path, const DbcVocabulary& contract);

/// Reads a scenario's text; `name` is the file's name in messages. Settings replace values of the text and
/// are validated in the same way. `folder` contains the files that the text names; by default it is the
/// folder of `name`.
Result<Scenario> parse(std::string_view text, std::string_view name, const DbcVocabulary& contract,
                       std::span<const Setting> settings = {}, std::optional<std::string> folder = {});

/// Appends the [[fault]] tables of another text, or some of them. An error is one line of text.
Result<void> add_faults(Scenario& scenario, std::string_view text, std::string_view name,
                        const DbcVocabulary& contract, const FaultPlaces* some = nullptr);

/// Size limit of a scenario or campaign file.
inline constexpr std::size_t most_toml_bytes = std::size_t{1} << 20U;

/// Why the scenario does not know a truth; empty: the truth is known. `samples`: NodeTable::samples.
std::string why_no_truth(const Scenario& scenario, std::string_view samples);
std::string why_no_truth(const Scenario& scenario, const world::TruthValue& value);
/// Why there is no truth to compare an estimator's answers with; empty: there is a truth, or the scenario has
/// none of the estimator's nodes.
std::string why_no_truth(const Scenario& scenario, const EstimatorFacts& facts);

}  // namespace canhil::scenario
