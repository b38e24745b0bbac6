// Reads the files that a user names: DBC, scenarios and campaigns, reports.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil {

inline constexpr std::size_t mebibyte = std::size_t{1} << 20U;

/// The content of a file, a pipe or a device, read until its end. Error: one line with the path that says
/// that it cannot be read, and why, or that it holds more than `most_bytes`, and that `kind` was expected. No
/// more than that is read: a device may have no end.
Result<std::string> read_text_file(const std::filesystem::path& path, std::string_view kind,
                                   std::size_t most_bytes);

}  // namespace canhil
