// Writes files completely or not at all.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::report {

/// A file name with this value means standard output.
inline constexpr std::string_view to_stdout = "-";

/// Writes to standard output immediately. An error is one line of text.
Result<void> write_stdout(std::string_view content);

/// Receives the parts of a content in their order.
using Sink = std::function<void(std::string_view part)>;

/// Writes a file under a temporary name and then renames it. After an error, which is one line of text, an
/// existing file is unchanged. `content` passes the parts of the content to the sink one by one, so a large
/// content is never in memory as a whole.
Result<void> write_file(const std::string& path, const std::function<void(const Sink&)>& content);
Result<void> write_file(const std::string& path, std::string_view content);

/// Writes to standard output or a file, depending on `path`.
Result<void> write(const std::string& path, std::string_view content);

/// Checks, before a long run, whether a file can be written: the folder of the file must be writable, and an
/// existing file must be a regular file. The error is one line of text. The path "-" is always an error.
Result<void> check_writable(const std::string& path);

/// Checks that all non-empty paths name different files. The error is one line with the path that is given
/// twice.
Result<void> check_distinct(const std::vector<std::string>& paths);

}  // namespace canhil::report
