// Reads text files whose paths the user gives: DBC files, scenarios, campaigns, reports.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil {

/// The number of bytes in a mebibyte.
inline constexpr std::size_t mebibyte = std::size_t{1} << 20U;

/// The content of a file, a pipe or a device. Reads at most `most_bytes`, because a device may have no end.
/// The error is one line with the path, the reason (unreadable, or more than `most_bytes`) and `kind`, the
/// kind of file that is expected.
Result<std::string> read_text_file(const std::filesystem::path& path, std::string_view kind,
                                   std::size_t most_bytes);

}  // namespace canhil
