// A temporary folder for one process of a test program. CTest runs each case in a separate process, and
// several processes at the same time, so each process needs a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace canhil::test {

/// The folder is removed when the process that created it ends; the end of a child process does not remove
/// it. If a test failed, the folder is kept, so that its files can be inspected.
class OwnFolder {
 public:
  // A process that was killed left its folder, and its id may come again.
  OwnFolder() {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~OwnFolder() {
    if (getpid() != made_by_ || !testing::UnitTest::GetInstance()->Passed()) return;
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

 private:
  const pid_t made_by_ = getpid();

 public:
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("canhil-" + std::to_string(made_by_));
};

/// The folder of this process; it exists until the program ends.
inline std::string own_folder() {
  static const OwnFolder own;
  return own.path.string();
}

}  // namespace canhil::test
