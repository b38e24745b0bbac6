// Everything in a table of TOML as settings. toml++ is heavy: for section.cpp alone.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "bench/scenario/setting.hpp"

namespace canhil::scenario {

/// Appends what is in a table, tables in it as keys with dots behind `path`.
void add_settings(const toml::table& table, const std::string& path, std::vector<Setting>& settings);

}  // namespace canhil::scenario
