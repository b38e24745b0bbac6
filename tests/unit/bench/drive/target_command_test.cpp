#include "bench/drive/target_command.hpp"
#include "bench/drive/file_identity.hpp"
#include "bench/processes/command.hpp"
#include "tests/own_folder.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace canhil::drive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(TargetCommand, ThatIsWrongIsOneLine) {
  EXPECT_EQ(target_words("mine 'a").error().message,
            "target 'mine 'a': a quote (') has no end, expected a second one");
  EXPECT_TRUE(check_target("sh -c true"));
  EXPECT_THAT(check_target("no-such-program x").error().message,
              HasSubstr("target 'no-such-program': is not a program"));
}

// The file of the interpreter does not identify the version of a script.
TEST(TargetCommand, FilesAmongTheArgumentsAreLookedAtToo) {
  const std::string script = test::own_folder() + "/target_command_test.py";
  std::ofstream(script) << "1\n";
  const std::string command = "sh " + script + " --gain 3 " + script;
  EXPECT_THAT(files_of_target(command), ElementsAre(processes::program_path("sh"), script));
  const auto before = identify_file(script);
  std::ofstream(script) << "2\n";
  const auto after = identify_file(script);
  ASSERT_TRUE(before && after);
  EXPECT_NE(before->sha256, after->sha256);
  std::filesystem::remove(script);
}

}  // namespace
}  // namespace canhil::drive
