// Converts a TOML table to settings. This header includes toml++, which is slow to compile, so only
// section.cpp and edited_text.cpp should use it.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "bench/scenario/setting.hpp"

namespace canhil::scenario {

/// A value as TOML text. A number has the fewest digits that give it exactly.
std::string toml_text(const toml::node& node);

/// Appends the values of a table; nested tables become keys with dots after `path`.
void add_settings(const toml::table& table, const std::string& path, std::vector<Setting>& settings);

}  // namespace canhil::scenario
