#include "dbc/files/text_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/own_folder.hpp"

namespace canhil {
namespace {

std::string file_of(std::size_t bytes) {
  std::string path = test::own_folder() + "/text_file_test_" + std::to_string(bytes);
  std::ofstream(path) << std::string(bytes, 'x');
  return path;
}

TEST(TextFile, IsReadWholeUpToItsLimit) {
  const std::string path = file_of(200'000);
  EXPECT_EQ(read_text_file(path, "a list", 200'000).value(), std::string(200'000, 'x'));
  EXPECT_EQ(read_text_file(file_of(0), "a list", 10).value(), "");
}

TEST(TextFile, BeyondItsLimitIsRefusedWithFileAndLimit) {
  const std::string path = file_of(100'001);
  EXPECT_EQ(read_text_file(path, "a list", 100'000).error().message,
            path + ": is larger than 100000 bytes, expected a list of at most that");
}

TEST(TextFile, ADeviceWithoutEndIsRefused) {
  EXPECT_EQ(read_text_file("/dev/zero", "a list", mebibyte).error().message,
            "/dev/zero: is larger than 1 MiB, expected a list of at most that");
}

TEST(TextFile, MayBeAPipe) {
  const std::string path = test::own_folder() + "/text_file_test_pipe";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::jthread writer([&path] { std::ofstream(path) << "through a pipe"; });
  EXPECT_EQ(read_text_file(path, "a list", 100).value(), "through a pipe");
}

TEST(TextFile, SaysWhyItCannotBeRead) {
  EXPECT_EQ(read_text_file("/nowhere/x", "a list", 100).error().message,
            "/nowhere/x: cannot be read (No such file or directory), expected a list");
  EXPECT_EQ(read_text_file("/tmp", "a list", 100).error().message,
            "/tmp: cannot be read (Is a directory), expected a list");
}

}  // namespace
}  // namespace canhil
