// A folder for temporary files.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "dbc/wire/result.hpp"

namespace canhil {

/// A private folder, mode 0700; the destructor removes it.
class TemporaryFolder {
 public:
  /// `name`: a part of its name. Error, one phrase: it cannot be made.
  static Result<std::unique_ptr<TemporaryFolder>> make(std::string_view name);
  /// Takes over a folder that is there.
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  /// Its path.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace canhil
