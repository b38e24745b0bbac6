// An FMU's file: a zip archive.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::plant::fmu {

inline constexpr std::size_t most_packed_bytes = std::size_t{512} << 20U;
inline constexpr std::size_t most_unpacked_bytes = std::size_t{2} << 30U;

/// A zip archive in memory, whose entries are files and folders below its root: none climbs out of it, none
/// is a link, and all together have at most `most_unpacked_bytes`. It may be read in several threads.
class Archive {
 public:
  /// Errors, one phrase each: not a zip archive, an entry that is refused, too large.
  static Result<Archive> open(std::string content);
  Archive() = default;

  /// The names of its files and folders.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] bool has(const std::string& name) const;
  /// The content of a file. Error, one phrase: it is missing, damaged, or larger than `most_bytes`.
  [[nodiscard]] Result<std::string> read(const std::string& name, std::size_t most_bytes) const;
  /// Writes all files below a folder that is empty. Error, one phrase.
  [[nodiscard]] Result<void> unpack(const std::filesystem::path& folder) const;

 private:
  std::shared_ptr<const std::string> content_;
  std::vector<std::string> names_;
};

}  // namespace canhil::plant::fmu
