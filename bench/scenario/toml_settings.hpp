// Converts a TOML table to settings. Includes toml++, which is heavy: for section.cpp alone.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "bench/scenario/setting.hpp"

namespace canhil::scenario {

/// Appends the values of a table; nested tables become keys with dots after `path`.
void add_settings(const toml::table& table, const std::string& path, std::vector<Setting>& settings);

}  // namespace canhil::scenario
