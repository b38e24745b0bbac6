// The vocabulary of scenarios from the DBC that this bench was built with.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bench/mapping/mapping.hpp"
#include "bench/scenario/contract.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::drive {

/// Value tables and messages of the built-in DBC.
scenario::DbcVocabulary contract();

/// Reads a scenario with the vocabulary of the mapping in its [target], or else of canhil's own DBC.
/// Otherwise like scenario::parse() and read_file(). `folder`: see scenario::parse(). `read`: loads mapping
/// and DBC.
Result<scenario::Scenario> parse_scenario(std::string_view text, const std::string& name,
                                          std::span<const scenario::Setting> settings = {},
                                          std::optional<std::string> folder = {},
                                          const mapping::ReadText& read = mapping::read_from_disk);
Result<scenario::Scenario> read_scenario(const std::string& file);

/// Adds the [[fault]] tables of a file to the scenario. Error: one line.
Result<void> add_faults(scenario::Scenario& scenario, const std::string& file);
/// The same for the text of a file, or for some of its faults.
Result<void> add_faults(scenario::Scenario& scenario, std::string_view text, const std::string& name,
                        const scenario::FaultPlaces* some = nullptr);

}  // namespace canhil::drive
