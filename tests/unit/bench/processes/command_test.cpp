#include "bench/processes/command.hpp"
#include "tests/own_folder.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace canhil::processes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Command, IsSplitAsAShellSplitsSimpleWords) {
  EXPECT_THAT(words_of("./mine").value(), ElementsAre("./mine"));
  EXPECT_THAT(words_of("  python3\tmine.py   --gain 3 ").value(),
              ElementsAre("python3", "mine.py", "--gain", "3"));
  EXPECT_THAT(words_of(R"('/a b/mine' "it's" '"' x'y z'"w" a\ b)").value(),
              ElementsAre("/a b/mine", "it's", "\"", "xy zw", "a b"));
  EXPECT_THAT(words_of("mine '' $HOME *").value(), ElementsAre("mine", "", "$HOME", "*"));
  EXPECT_THAT(words_of(R"(mine "a\"b" 'a\b')").value(), ElementsAre("mine", "a\"b", "a\\b"));
}

TEST(Command, ThatCannotBeSplitIsOnePhrase) {
  EXPECT_THAT(words_of("mine 'a").error().message, HasSubstr("a quote (') has no end"));
  EXPECT_THAT(words_of("   ").error().message, HasSubstr("has no word"));
  EXPECT_THAT(words_of("'' x").error().message, HasSubstr("has no word"));
}

TEST(Command, QuotesAPathThatHasToBe) {
  EXPECT_EQ(quoted_word("/usr/bin/hil-target"), "/usr/bin/hil-target");
  for (const std::string path : {"/a b/it's", "", "$x", "\\"}) {
    const std::string command = "x " + quoted_word(path);
    EXPECT_EQ(words_of(command).value().at(1), path) << command;
  }
}

TEST(Command, ProgramIsFoundAsAShellFindsIt) {
  EXPECT_EQ(program_path("/no/such/program"), "/no/such/program");
  EXPECT_EQ(program_path("no-such-program"), "no-such-program");
  EXPECT_TRUE(std::filesystem::path(program_path("sh")).is_absolute());
}

TEST(Command, AProgramInTheWorkingFolderPrecedesTheOneInPath) {
  std::ofstream(test::own_folder() + "/sh") << "\n";
  EXPECT_EQ(program_path("sh", test::own_folder()), "sh");
  std::filesystem::remove(test::own_folder() + "/sh");
}

}  // namespace
}  // namespace canhil::processes
