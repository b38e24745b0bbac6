// A scenario file, read and validated: one flight, who is on the bus, what the target is told, and what it is
// judged by.
//
// In the file values have the unit in their key (heading_deg); in the structs they are SI and radians, times
// in us. Each section of the file is a struct with a reader of its own; those of nodes stand in bench/nodes
// and are given with the contract. Reading is strict: an unknown key, a wrong type, a value out of range or a
// missing key ends it with one line, "file:line: key 'slave_imu.period_ms': what is wrong, expected what".
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
#include "bench/scenario/faults.hpp"
#include "bench/scenario/glide.hpp"
#include "bench/scenario/node.hpp"
#include "bench/scenario/setting.hpp"
#include "bench/scenario/target_setup.hpp"
#include "bench/world/engagement/plan.hpp"
#include "bench/world/motion.hpp"
#include "bench/world/navigation_errors.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::scenario {

/// A file that a scenario was made of, beside its own.
struct InputFile {
  std::string role;  ///< "recording", "faults"
  std::string path;
};

struct Scenario {
  std::string file;  ///< as it was named
  std::vector<InputFile> inputs{};
  std::uint64_t hash = 0;  ///< FNV-1a of text, settings and recordings: provenance in reports and campaigns
  std::uint64_t recordings_hash = 0;  ///< of these alone; 0: it flies none
  std::string title;
  std::int64_t duration_us = 0;
  std::uint64_t seed = 0;
  std::optional<bool> fd;  ///< what it says of the bus's contract: canhil-fd, or canhil

  std::shared_ptr<const Foreign> foreign;  ///< null: the target speaks the project's own contract
  std::vector<TargetSetup> targets;        ///< one for each estimator that the target runs
  world::Flight truth;                     ///< at rest where nothing navigates
  world::InitialErrorModel initial_error;  ///< of the state the target is told, w.r.t. the truth at the start
  std::optional<Glide> glide;              ///< the truth of a glider, beside the navigation's
  std::optional<world::EngagementPlan> engagement;
  std::vector<NodeSettings> nodes;  ///< those on the bus
  std::vector<Fault> faults;
  std::vector<Check> checks;

  /// False: answers cannot be held against the carrier's flight.
  [[nodiscard]] bool truth_is_known() const { return !std::holds_alternative<world::Unknown>(truth.motion); }
  [[nodiscard]] bool runs(std::string_view estimator) const {
    return std::ranges::find(targets, estimator, &TargetSetup::estimator) != targets.end();
  }
  /// The node that the table of this name puts on the bus; null: there is none.
  [[nodiscard]] const NodeSettings* node(std::string_view key) const {
    const auto found = std::ranges::find(nodes, key, [](const NodeSettings& one) { return one.table().key; });
    return found == nodes.end() ? nullptr : &*found;
  }
};

/// Reads a scenario file. The error is one line.
Result<Scenario> read_file(const std::filesystem::path& path, const Contract& contract);

/// Reads a scenario's text; `name` stands for the file in messages. Settings replace what the text says, and
/// are read as strictly. Files that it names are in `folder`, by default that of `name`.
Result<Scenario> parse(std::string_view text, std::string_view name, const Contract& contract,
                       std::span<const Setting> settings = {}, std::optional<std::string> folder = {});

/// Appends the [[fault]] tables of another text, or some of them. The error is one line.
Result<void> add_faults(Scenario& scenario, std::string_view text, std::string_view name,
                        const Contract& contract, const FaultPlaces* some = nullptr);

/// At most so much is read of a scenario or campaign file.
inline constexpr std::size_t most_toml_bytes = std::size_t{1} << 20U;

/// Why the answers of an estimator, which may do without nodes, have no truth to be held against; empty: they
/// have one.
std::string why_no_truth(const Scenario& scenario, const EstimatorFacts& facts);

}  // namespace canhil::scenario
