// A folder of this test program alone: CTest runs each case as a process of its own, several at a time.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace canhil::test {

class OwnFolder {
 public:
  OwnFolder()
      : path_(std::filesystem::temp_directory_path() / ("canhil-unit-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~OwnFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// Until the program ends.
inline std::string own_folder() {
  static const OwnFolder own;
  return own.path();
}

}  // namespace canhil::test
