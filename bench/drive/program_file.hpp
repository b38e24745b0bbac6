// Identifies the version of a program that was started.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace canhil::drive {

/// A program file on disk.
struct ProgramFile {
  std::uint64_t hash = 0;       ///< FNV-1a of its bytes
  std::uint64_t bytes = 0;      ///< its size
  std::int64_t modified_s = 0;  ///< since 1970, UTC
};

/// None: not a regular file, or not readable.
std::optional<ProgramFile> look_at_program(const std::string& path);

}  // namespace canhil::drive
