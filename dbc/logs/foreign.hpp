// Formats of recordings that canhil does not read or write, and the programs that convert them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace canhil::logs {

/// The number of bytes at the beginning of a file by which formats are told apart.
inline constexpr std::size_t beginning_size = 24;

/// What a file in a format that is not read is, and how to convert it; nullopt: its beginning is of none of
/// the known ones. `name` is the name of the file.
std::optional<std::string> foreign_format(std::string_view beginning, const std::string& name);

/// How to write a log with this ending (in lower case, such as ".trc"), as a further part of a message;
/// empty: unknown.
std::string how_to_write(std::string_view ending);

}  // namespace canhil::logs
