// Files that are whole or not there.
#pragma once

#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil::report {

/// Writes a file under a temporary name and renames it. Error: one line; then whatever stood under the name
/// still does.
Result<void> write_file(const std::string& path, std::string_view content);

/// Whether a file could be written there, before a long run: its folder exists and is writable.
Result<void> check_writable(const std::string& path);

}  // namespace canhil::report
