#include "bench/drive/target_command.hpp"
#include "bench/drive/file_identity.hpp"
#include "tests/own_folder.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace canhil::drive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(TargetCommand, IsSplitAsAShellSplitsSimpleWords) {
  EXPECT_THAT(target_words("./mine").value(), ElementsAre("./mine"));
  EXPECT_THAT(target_words("  python3\tmine.py   --gain 3 ").value(),
              ElementsAre("python3", "mine.py", "--gain", "3"));
  EXPECT_THAT(target_words(R"('/a b/mine' "it's" '"' x'y z'"w" a\ b)").value(),
              ElementsAre("/a b/mine", "it's", "\"", "xy zw", "a b"));
  EXPECT_THAT(target_words("mine '' $HOME *").value(), ElementsAre("mine", "", "$HOME", "*"));
  EXPECT_THAT(target_words(R"(mine "a\"b" 'a\b')").value(), ElementsAre("mine", "a\"b", "a\\b"));
}

TEST(TargetCommand, ThatCannotBeSplitIsOneLine) {
  EXPECT_THAT(target_words("mine 'a").error().message, HasSubstr("a quote (') has no end"));
  EXPECT_THAT(target_words("   ").error().message, HasSubstr("has no word"));
  EXPECT_THAT(target_words("'' x").error().message, HasSubstr("has no word"));
}

TEST(TargetCommand, QuotesAPathThatHasToBe) {
  EXPECT_EQ(quoted_word("/usr/bin/hil-target"), "/usr/bin/hil-target");
  for (const std::string path : {"/a b/it's", "", "$x", "\\"}) {
    const std::string command = "x " + quoted_word(path);
    EXPECT_EQ(target_words(command).value().at(1), path) << command;
  }
}

TEST(TargetCommand, ProgramIsFoundAsAShellFindsIt) {
  EXPECT_EQ(program_path("/no/such/program"), "/no/such/program");
  EXPECT_EQ(program_path("no-such-program"), "no-such-program");
  EXPECT_TRUE(std::filesystem::path(program_path("sh")).is_absolute());
  EXPECT_TRUE(check_target("sh -c true"));
  EXPECT_THAT(check_target("no-such-program x").error().message,
              HasSubstr("target 'no-such-program': is not a program"));
}

// The file of the interpreter does not identify the version of a script.
TEST(TargetCommand, FilesAmongTheArgumentsAreLookedAtToo) {
  const std::string script = test::own_folder() + "/target_command_test.py";
  std::ofstream(script) << "1\n";
  const std::string command = "sh " + script + " --gain 3 " + script;
  EXPECT_THAT(files_of_target(command), ElementsAre(program_path("sh"), script));
  const auto before = identify_file(script);
  std::ofstream(script) << "2\n";
  const auto after = identify_file(script);
  ASSERT_TRUE(before && after);
  EXPECT_NE(before->sha256, after->sha256);
  std::filesystem::remove(script);
}

}  // namespace
}  // namespace canhil::drive
