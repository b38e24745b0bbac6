#include "dbc/files/output_file.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "dbc/files/command_files.hpp"
#include "tests/own_folder.hpp"

namespace canhil {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string message_of(const Result<void>& result) { return result ? "" : result.error().message; }

class OutputFiles : public testing::Test {
 protected:
  OutputFiles() { fs::create_directories(folder_); }
  ~OutputFiles() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string in(const std::string& name) const { return (folder_ / name).string(); }

  const fs::path folder_ = fs::path(test::own_folder()) / "outputs";
};

TEST_F(OutputFiles, HaveNamesThatNobodyForesees) {
  auto one = OutputFile::create(in("x")), other = OutputFile::create(in("x"));
  ASSERT_TRUE(one && other);
  EXPECT_NE(one->temporary_name(), other->temporary_name());
  EXPECT_THAT(one->temporary_name(), Not(HasSubstr("." + std::to_string(getpid()) + ".")));
}

TEST_F(OutputFiles, OfAFailedContentLeaveTheOldFile) {
  std::ofstream(in("old")) << "mine";
  const auto written = write_file_unless_failed(in("old"), [](const Sink& give) -> Result<void> {
    give("half");
    return failure("the content failed");
  });
  EXPECT_EQ(message_of(written), "the content failed");
  std::ifstream file(in("old"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(OutputFiles, AreThereOnlyUnderTheirName) {
  {
    auto kept = OutputFile::create(in("kept")), lost = OutputFile::create(in("lost"));
    ASSERT_TRUE(kept && lost);
    std::FILE* stream = kept->take_stream();
    ASSERT_NE(stream, nullptr);
    EXPECT_GE(std::fputs("all", stream), 0);
    EXPECT_EQ(std::fclose(stream), 0);
    EXPECT_EQ(kept->give_name(in("kept")), 0);
  }
  ASSERT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
  std::ifstream file(in("kept"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "all");
}

TEST_F(OutputFiles, ReplaceALinkAndNotItsTarget) {
  std::ofstream(in("victim")) << "precious";
  fs::create_symlink(in("victim"), in("link"));
  EXPECT_THAT(message_of(check_writable(in("link"))), HasSubstr("is not a regular file"));
  EXPECT_TRUE(write_file(in("link"), "new"));
  EXPECT_EQ(fs::file_size(in("victim")), 8U);
  fs::create_symlink(in("nothing"), in("dangling"));
  EXPECT_THAT(message_of(create_new_file(in("dangling"))), HasSubstr("File exists"));
  EXPECT_FALSE(fs::exists(in("nothing")));
}

TEST_F(OutputFiles, AreComparedByTheFileAndNotByTheName) {
  std::ofstream(in("input")) << "x";
  fs::create_hard_link(in("input"), in("hard"));
  fs::create_symlink(in("input"), in("soft"));
  fs::create_directory_symlink(folder_, in("folder"));
  for (const char* name : {"input", "hard", "soft", "folder/input", "../outputs/./input"}) {
    CommandFiles files;
    files.reads("mapping", in("input"));
    files.writes("--json", in(name));
    EXPECT_THAT(message_of(files.check_distinct()),
                AllOf(HasSubstr("--json '" + in(name) + "': is the same file as mapping '" + in("input")),
                      Not(HasSubstr("\n"))));
  }
  CommandFiles files;
  files.reads("mapping", in("input"));
  files.writes("--json", in("other"));
  files.may_write("log", in("new/folder/../x"));
  EXPECT_EQ(message_of(files.check()), "");
  files.writes_file("--csv", in("folder/new/x"));
  EXPECT_THAT(message_of(files.check_distinct()), HasSubstr("is the same file as log"));
}

TEST_F(OutputFiles, ShareNoStandardOutput) {
  CommandFiles files;
  files.reads("mapping", "-");  // a file of this name
  files.writes("--json", "-");
  EXPECT_EQ(message_of(files.check()), "");
  files.writes("--junit", "-");
  EXPECT_EQ(message_of(files.check()),
            "--json -, --junit -: both to standard output, expected only one of them");
  CommandFiles tables;
  tables.writes_file("--csv", "-");
  EXPECT_EQ(message_of(tables.check()), "--csv -: standard output cannot hold this, expected a file");
}

TEST_F(OutputFiles, IncludeNotTheProgramItself) {
  CommandFiles files;
  files.writes("--json", fs::read_symlink("/proc/self/exe").string());
  EXPECT_THAT(message_of(files.check_distinct()), HasSubstr("is the same file as program"));
}

}  // namespace
}  // namespace canhil
