// Writes reports to files or to standard output.
#pragma once

#include <string>
#include <string_view>

#include "dbc/files/output_file.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::report {

using canhil::Sink;
using canhil::write_file;

/// A file name with this value means standard output.
inline constexpr std::string_view to_stdout = "-";

/// Writes to standard output immediately. An error is one line of text.
Result<void> write_stdout(std::string_view content);

/// Writes text for people to standard output, escaped by for_terminal().
Result<void> show(std::string_view text);

/// Writes to standard output or a file, depending on `path`.
Result<void> write(const std::string& path, std::string_view content);

}  // namespace canhil::report
