// A scenario with a mapping whose files are texts in the test.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "bench/drive/contract.hpp"

namespace canhil::mapping {

/// Reads a scenario whose [target] names ecu.mapping.toml, which names ecu.dbc.
inline Result<scenario::Scenario> read_mapped(std::string_view scenario, std::string mapping,
                                              std::string dbc) {
  const std::map<std::string, std::string> files{{"ecu.mapping.toml", std::move(mapping)},
                                                 {"ecu.dbc", std::move(dbc)}};
  return drive::parse_scenario(
      scenario, "a.toml", {}, {},
      [&](const std::string& file) -> Result<std::string> { return files.at(file); });
}

}  // namespace canhil::mapping
