// The vocabulary of scenarios. It comes from the DBC that this bench was built with.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bench/mapping/mapping.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::drive {

/// The vocabulary with the built-in DBC. It contains the value tables and messages of this DBC, and the kinds
/// of checks, nodes and faults.
scenario::DbcVocabulary contract();

/// Reads a scenario. The vocabulary comes from the mapping that the scenario's [target] names. If [target]
/// names no mapping, the vocabulary comes from canhil's own DBC. In all other respects, parse_scenario()
/// works like scenario::parse(), and read_scenario() works like scenario::read_file(). `folder`: see
/// scenario::parse(). `read`: loads the mapping and its DBC.
Result<scenario::Scenario> parse_scenario(std::string_view text, const std::string& name,
                                          std::span<const scenario::Setting> settings = {},
                                          std::optional<std::string> folder = {},
                                          const mapping::ReadText& read = mapping::read_from_disk);
Result<scenario::Scenario> read_scenario(const std::string& file,
                                         std::span<const scenario::Setting> settings = {});

/// Adds the [[fault]] tables of a file to the scenario. Error: one line.
Result<void> add_faults(scenario::Scenario& scenario, const std::string& file);
/// Adds the [[fault]] tables in `text` to the scenario. `text`: the contents of a file. `some`: if not null,
/// adds only these faults of the file.
Result<void> add_faults(scenario::Scenario& scenario, std::string_view text, const std::string& name,
                        const scenario::FaultPlaces* some = nullptr);

}  // namespace canhil::drive
