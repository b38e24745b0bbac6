// A plant that is a program: what it gets, and what becomes of its answers.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "bench/scenario/scenario.hpp"
#include "tests/unit/bench/plant/closed_loop.hpp"
#include "tests/unit/bench/plant/read_plan.hpp"
#include "tests/unit/bench/plant/scripts.hpp"

namespace canhil::plant {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string content(const std::string& name) {
  std::ifstream file(test::own_folder() + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Program, GetsParametersDrawAndInputsInTheFolderOfItsScenario) {
  // It writes what it reads to a file in its working folder.
  test::script(
      "heard.sh",
      "echo $# $1 > heard\n"
      "while read line; do\n"
      "  echo \"$line\" >> heard\n"
      "  case $line in\n"
      "    start) printf 'input valve 1 start=0.5\\ninput rudder rad\\noutput level m\\nstate 1\\n' ;;\n"
      "    step*) echo state 2 ;;\n"
      "  esac\n"
      "done");
  const auto plan = good_plan("program",
                              "command = \"./heard.sh 'two words'\"\n"
                              "[plant.parameters]\nmass = 3\nnote = \"a b\"\n");
  ASSERT_NE(plan, nullptr);
  EXPECT_EQ(content("heard"),
            "1 two words\ncanhil-plant 1\nseed 0\nrun 0\nnumber mass 3\ntext note a b\nstart\nend\n");
  ASSERT_EQ(plan->inputs.size(), 2U);
  EXPECT_EQ(plan->inputs[0].start, 0.5);
  EXPECT_EQ(plan->inputs[1].si, "rad");
  {
    const auto plant = made(*plan, {.seed = 7, .run_index = 4});
    ASSERT_NE(plant, nullptr);
    EXPECT_THAT(values(*plant), ElementsAre(1));
    EXPECT_TRUE(plant->step(0, 20'000, std::vector{0.1, -2.0}));
    EXPECT_THAT(values(*plant), ElementsAre(2));
  }
  EXPECT_EQ(content("heard"),
            "1 two words\ncanhil-plant 1\nseed 7\nrun 4\nnumber mass 3\ntext note a b\nstart\nstep 0 20000 "
            "0.1 -2\nend\n");
}

TEST(Program, IsFoundWithoutASlash) {
  test::script("here.sh", test::up_to_first_step);
  EXPECT_NE(good_plan("program", "command = 'here.sh'\n"), nullptr) << "in the folder of the scenario";
  EXPECT_NE(good_plan("program", "command = 'sh here.sh'\n"), nullptr) << "in PATH";
}

TEST(Program, MayEndItsLinesAsOnWindows) {
  test::script("crlf.sh", "printf 'output level m\\r\\nstate 4\\r\\n'; read line; sleep 10");
  const auto plan = good_plan("program", "command = 'crlf.sh'\n");
  ASSERT_NE(plan, nullptr);
  EXPECT_THAT(values(*made(*plan)), ElementsAre(4));
}

TEST(Program, MayWriteALineInParts) {
  test::script("parts.sh",
               test::up_to_first_step +
                   "printf 'sta'; sleep 0.02; printf 'te 3'; sleep 0.02; printf ' 4\\n'; read step");
  const auto plan = good_plan("program", "command = 'parts.sh'\n");
  ASSERT_NE(plan, nullptr);
  const auto plant = made(*plan);
  ASSERT_TRUE(plant->step(0, 10'000, std::vector{0.0}));
  EXPECT_THAT(values(*plant), ElementsAre(3, 4));
}

TEST(Program, FilesOfItsCommandBelongToTheScenario) {
  const auto hash = [] { return read_plan("program", "command = 'sh hashed.sh'\n").files_hash; };
  test::script("hashed.sh", test::up_to_first_step);
  const auto before = hash();
  EXPECT_EQ(hash(), before);
  test::script("hashed.sh", test::up_to_first_step + "# changed");
  EXPECT_NE(hash(), before);
}

TEST(Program, IsAFileOfTheRun) {
  const std::string path =
      test::script("craft.sh",
                   "while read line && [ \"$line\" != start ]; do :; done\n"
                   "echo input rudder rad; echo output attitude.heading rad turns; echo state 1");
  std::string text = closed_loop;
  const auto begin = text.find("kind = \"steered_heading\""), end = text.find("[master_ins]");
  text.replace(begin, end - begin, "kind = 'program'\ncommand = 'sh " + path + "'\n");
  const auto scenario = read_loop(text);
  ASSERT_TRUE(scenario) << scenario.error().message;
  ASSERT_EQ(scenario->inputs.size(), 1U);
  EXPECT_EQ(scenario->inputs.front().role, "plant");
  EXPECT_EQ(scenario->inputs.front().path, path);
}

TEST(Program, SeveralOfThemRunAtTheSameTime) {
  test::script(
      "own.sh",
      "while read line && [ \"$line\" != start ]; do case $line in run*) own=${line#run }; esac; done\n"
      "printf 'output number 1\\nstate 0\\n'; while read step; do echo state $own; done");
  const auto plan = good_plan("program", "command = 'own.sh'\n");
  ASSERT_NE(plan, nullptr);
  std::vector<std::unique_ptr<Plant>> plants;
  for (std::uint64_t i = 0; i < 8; ++i) plants.push_back(made(*plan, {.run_index = i}));
  for (std::size_t i = 0; i < plants.size(); ++i) {
    ASSERT_TRUE(plants[i]->step(0, 10'000, {}));
    EXPECT_THAT(values(*plants[i]), ElementsAre(static_cast<double>(i)));
  }
}

TEST(Program, KeysAreChecked) {
  EXPECT_THAT(read_plan("program", "").error, HasSubstr("key 'plant.command': is missing"));
  EXPECT_THAT(read_plan("program", "command = \"a 'b\"\n").error,
              HasSubstr("key 'plant.command': a quote (') has no end"));
  EXPECT_THAT(read_plan("program", "command = 'sh x'\nanswers_within_s = 0\n").error,
              HasSubstr("key 'plant.answers_within_s'"));
  EXPECT_THAT(read_plan("program", "command = 'sh x'\n[plant.parameters]\nmass = [1]\n").error,
              HasSubstr("key 'plant.parameters.mass'"));
  EXPECT_THAT(read_plan("program", "command = 'sh x'\n[plant.parameters]\n'a b' = 1\n").error,
              HasSubstr("is not a name"));
}

}  // namespace
}  // namespace canhil::plant
