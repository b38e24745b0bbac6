// Identifies a version of a file: its hash, size and date.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace canhil::drive {

/// Identifies the content of a file on disk.
struct FileIdentity {
  std::string sha256;           ///< hash of the content, 64 hexadecimal digits as sha256sum prints them
  std::uint64_t bytes = 0;      ///< size of the file
  std::int64_t modified_s = 0;  ///< time of the last change, since 1970, UTC; 0: unknown
};

/// Reads a file. None: the path is not a regular file, or cannot be read.
std::optional<FileIdentity> identify_file(const std::string& path);

}  // namespace canhil::drive
