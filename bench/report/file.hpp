// Files that are whole or not there.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::report {

/// In place of a file's name.
inline constexpr std::string_view to_stdout = "-";

/// Writes to standard output, now. Error: one line.
Result<void> write_stdout(std::string_view content);

/// Takes the parts of a content in their order.
using Sink = std::function<void(std::string_view part)>;

/// Writes a file under a temporary name and renames it. Error: one line; then whatever stood under the name
/// still does. `content` gives it, part by part, so a large one needs no room in memory.
Result<void> write_file(const std::string& path, const std::function<void(const Sink&)>& content);
Result<void> write_file(const std::string& path, std::string_view content);

/// To standard output or a file, as `path` says.
Result<void> write(const std::string& path, std::string_view content);

/// Whether a file could be written there, before a long run: its folder is writable, and what stands under
/// the name, if anything, is a regular file. Error: one line, as for "-".
Result<void> check_writable(const std::string& path);

/// Whether all paths (empty ones left out) name different files. Error: one line with the path named twice.
Result<void> check_distinct(const std::vector<std::string>& paths);

}  // namespace canhil::report
