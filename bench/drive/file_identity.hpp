// Identifies a version of a file: its hash, size and date.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace canhil::drive {

/// Identifies the content of a file on disk.
struct FileIdentity {
  std::string sha256;           ///< of its bytes, 64 hexadecimal digits as sha256sum prints them
  std::uint64_t bytes = 0;      ///< its size
  std::int64_t modified_s = 0;  ///< since 1970, UTC; 0: unknown
};

/// Reads a file. None: it is not a regular file, or cannot be read.
std::optional<FileIdentity> identify_file(const std::string& path);

}  // namespace canhil::drive
