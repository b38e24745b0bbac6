// Checks that are programs of the user.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

struct Judged {
  Ended ended;
  nlohmann::json report;
};

// Flies los_quick with one check in place of its own.
Judged fly(const std::string& command, const std::string& keys = "", const std::string& options = "") {
  std::string text = read(scenario("los_quick"));
  text = text.substr(0, text.find("[[check]]"));
  std::ofstream(scratch("program.toml"))
      << text << "[[check]]\nname = 'own'\nkind = 'program'\ncommand = \"" << command << "\"\n"
      << keys;
  const std::string json = scratch("program.json");
  std::filesystem::remove(json);
  Judged judged{.ended = hil_bench("run " + scratch("program.toml") + " --bus in-process --json " + json +
                                   " " + options),
                .report = {}};
  if (std::filesystem::exists(json)) judged.report = read_json(json);
  return judged;
}

std::string program(const std::string& text) {
  std::ofstream(scratch("own.py")) << text;
  return "python3 own.py";
}

TEST(ProgramCheck, JudgesTheReportAndTheTableOfTheRun) {
  const std::string example = "python3 " SOURCE_DIR "/docs/examples/check/range_rate.py --limit ";
  const Judged good = fly(example + "5");
  EXPECT_EQ(good.ended.code, 0) << good.ended.err << good.ended.out;
  ASSERT_EQ(good.report["checks"].size(), 1U);
  const nlohmann::json& check = good.report["checks"][0];
  EXPECT_EQ(check["name"], "own: closing speed");
  EXPECT_EQ(check["kind"], "program");
  EXPECT_EQ(check["outcome"], "pass");
  EXPECT_EQ(check["upper"], 5);
  EXPECT_GT(check["value"], 0);
  EXPECT_GT(check["margin"], 0.5);
  EXPECT_THAT(good.ended.out, HasSubstr("own: closing speed"));
  const Judged bad = fly(example + "1e-6");
  EXPECT_EQ(bad.ended.code, 1);
  EXPECT_EQ(bad.report["checks"][0]["outcome"], "fail");
}

TEST(ProgramCheck, HasAnyNumberOfJudgements) {
  const Judged judged = fly(program(
      "print('[{\"id\": \"a\", \"outcome\": \"pass\", \"requirement\": \"R1\"}, {\"id\": \"b\", \"outcome\": "
      "\"not measured\", \"measured\": \"no data\"}]')"));
  EXPECT_EQ(judged.ended.code, 3);
  ASSERT_EQ(judged.report["checks"].size(), 2U);
  EXPECT_EQ(judged.report["checks"][0]["requirement"], "R1");
  EXPECT_EQ(judged.report["checks"][1]["measured"], "no data");
  EXPECT_EQ(judged.report["reason"], "1 of 2 checks could not be measured: own: b");
}

TEST(ProgramCheck, ThatDoesNotAnswerAsItShouldIsNotMeasured) {
  const auto measured = [](const std::string& command, const std::string& keys = "") {
    const Judged judged = fly(command, keys);
    EXPECT_EQ(judged.ended.code, 3) << command;
    return judged.report["checks"][0]["measured"].get<std::string>();
  };
  EXPECT_EQ(measured(program("raise SystemExit(4)")), "the program exited with 4");
  EXPECT_EQ(measured(program("print('all is well')")), "the program wrote no JSON array of judgements");
  EXPECT_EQ(measured(program("print('[]')")), "the program judged nothing");
  EXPECT_EQ(measured(program("print('[{\"outcome\": \"pass\"}]')")),
            "the program wrote judgement 1: has no 'id'");
  EXPECT_EQ(measured(program("print('[{\"id\": \"a\", \"outcome\": \"good\"}]')")),
            "the program wrote judgement 1: outcome 'good' is unknown, expected pass, fail or not measured");
  EXPECT_EQ(measured(program("print('[' + ', '.join(['{\"id\": \"a\", \"outcome\": \"pass\"}'] * 2) + ']')")),
            "the program wrote judgement 2: id 'a' is there twice");
  EXPECT_THAT(measured("./no_such_program"), HasSubstr("cannot be started"));
  EXPECT_EQ(measured(program("import time\ntime.sleep(60)"), "within_s = 0.3\n"),
            "the program did not end within 0.3 s");
}

TEST(ProgramCheck, IsRefusedLikeAnyCommand) {
  const Judged refused = fly("python3 own.py", "", "--no-commands");
  expect_one_line(refused.ended, "is a program ('python3 own.py'), expected none with --no-commands");
  expect_one_line(fly("'open").ended, "key 'check[1].command'");
  expect_one_line(fly("python3 own.py", "within_s = 0\n").ended, "key 'check[1].within_s'");
}

TEST(ProgramCheck, LeavesNothingBehind) {
  const std::string folder = scratch("temporary");
  std::filesystem::create_directory(folder);
  ::setenv("TMPDIR", folder.c_str(), 1);
  fly(program("import sys\nassert sys.argv[1].startswith('" + folder + "')\nprint('[]')"));
  ::unsetenv("TMPDIR");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace canhil::test
