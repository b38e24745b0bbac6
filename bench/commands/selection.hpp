// Which scenarios a command takes: files, folders, and an expression that selects some of them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::commands {

/// The files of `scenarios`, a folder being replaced by the scenarios in it and below it, in the order of
/// their names. A scenario is a TOML file with the key `duration_s`; other TOML files of a folder, such as
/// mappings and campaigns, are passed over. Error, one line: a folder without a scenario, or a file of it
/// that cannot be read.
Result<std::vector<std::string>> scenario_files(const std::vector<std::string>& scenarios);

/// The title of a scenario; empty: the file has none, or cannot be read.
std::string title_of(const std::string& file);

/// Whether a text is selected.
using Selects = std::function<bool(std::string_view text)>;
/// Reads an expression of words with `and`, `or`, `not` and parentheses: a word holds for a text that
/// contains it, in upper or lower case. Error: one line.
Result<Selects> selection(std::string_view expression);

}  // namespace canhil::commands
