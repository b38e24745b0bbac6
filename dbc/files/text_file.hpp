// Reads the files that a user names: DBC, scenarios and campaigns, reports.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil {

/// 2^20 bytes.
inline constexpr std::size_t mebibyte = std::size_t{1} << 20U;

/// The content of a file, a pipe or a device. Reads at most `most_bytes`, as a device may have no end. Error:
/// one line with the path, the reason (unreadable, or more than `most_bytes`) and the expected `kind`.
Result<std::string> read_text_file(const std::filesystem::path& path, std::string_view kind,
                                   std::size_t most_bytes);

}  // namespace canhil
