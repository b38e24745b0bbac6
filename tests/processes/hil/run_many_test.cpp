// Tests `hil-bench run --set`, and runs of several scenarios in one call.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// A folder with two scenarios of which the first passes and the second fails, and a TOML file that is none.
std::string two_scenarios() {
  const std::string folder = scratch("two");
  fs::create_directories(folder + "/below");
  const std::string text = read(scenario("los_quick"));
  // Without its timing checks, the scenario can pass in virtual time.
  const std::string values = text.substr(0, text.find("[[check]]")) +
                             "[[check]]\nkind = \"error\"\nquantity = \"los.rate\"\nstatistic = \"rms\"\n"
                             "time_to_go_s = [2, 3]\nbelow_mradps = 2.3\n";
  std::ofstream(folder + "/good.toml") << values;
  std::ofstream(folder + "/below/bad.toml") << std::regex_replace(values, std::regex("2\\.3"), "0.1");
  std::ofstream(folder + "/campaign.toml") << "title = \"no scenario\"\nruns = 3\n";
  return folder;
}

TEST(Set, ReplacesAValueAndIsInEveryReport) {
  const std::string json = scratch("set.json"), junit = scratch("set.xml");
  const Ended ended =
      hil_bench(fmt::format("run {}/good.toml --bus in-process --set target.algorithm=low_pass --set "
                            "check.1.below_mradps=1000 --json {} --junit {}",
                            two_scenarios(), json, junit));
  EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("set target.algorithm = 'low_pass'\n  set check.1.below_mradps = 1000\n"));
  const nlohmann::json report = read_json(json);
  EXPECT_EQ(report.at("provenance").at("settings").at("check.1.below_mradps"), "1000");
  EXPECT_EQ(report.at("checks").at(0).at("upper"), 1000);
  EXPECT_THAT(read(junit), HasSubstr("<property name=\"set check.1.below_mradps\" value=\"1000\"/>"));
}

TEST(Set, RefusesWhatIsNoKeyOrNoValue) {
  const std::string run = fmt::format("run {}/good.toml --bus in-process --set ", two_scenarios());
  expect_one_line(hil_bench(run + "seeker.perod_ms=5"), "seeker.perod_ms': is unknown, expected 'period_ms'");
  expect_one_line(hil_bench(run + "seeker.period_ms=5ms"), "is a string, expected a number");
  expect_one_line(hil_bench(run + "seeker"), "--set 'seeker': expected KEY=VALUE");
  expect_one_line(hil_bench(run + "seed=1 --set seed=2"), "seed is set already, expected each key once");
}

TEST(RunMany, FliesAFolderWithOnePageAndOneJUnit) {
  const std::string folder = two_scenarios(), out = scratch("out"), junit = scratch("many.xml");
  const Ended ended =
      hil_bench(fmt::format("run {} --bus in-process -j 2 --out {} --junit {}", folder, out, junit));
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_THAT(ended.out, testing::ContainsRegex("FAIL +below-bad +1 of 1 check failed"));
  EXPECT_THAT(ended.out, testing::ContainsRegex("PASS +good +1 check passed"));
  EXPECT_THAT(ended.out, HasSubstr("\n1 passed, 1 failed\n"));
  EXPECT_EQ(read_json(out + "/good.json").at("verdict"), "pass");
  EXPECT_EQ(read_json(out + "/below-bad.json").at("verdict"), "fail");
  EXPECT_TRUE(fs::exists(out + "/good.log"));
  const std::string page = read(out + "/index.html");
  EXPECT_THAT(page, HasSubstr("href=\"good.html\""));
  EXPECT_THAT(page, HasSubstr("href=\"below-bad.html\""));
  EXPECT_TRUE(fs::exists(out + "/below-bad.html"));
  const std::string suites = read(junit);
  EXPECT_THAT(suites,
              testing::ContainsRegex("testsuite name.*failures=\"1\"(.|\n)*testsuite name.*failures=\"0\""));
}

TEST(RunMany, SelectsByWords) {
  const std::string folder = two_scenarios();
  const auto flown = [&](const std::string& words) {
    return hil_bench(fmt::format("run {} --bus in-process -k '{}'", folder, words)).out;
  };
  EXPECT_THAT(flown("good"), HasSubstr("\n1 passed\n"));
  EXPECT_THAT(flown("not GOOD"), HasSubstr("\n1 failed\n"));
  EXPECT_THAT(flown("(good or bad) and not (below and bad)"), HasSubstr("\n1 passed\n"));
  const std::string run = fmt::format("run {} --bus in-process -k ", folder);
  expect_one_line(hil_bench(run + "nothing"), "none of 2 scenarios has this");
  for (const std::string wrong : {"'good and'", "'(good'", "'good bad'", "'not'", "'or'"})
    expect_one_line(hil_bench(run + wrong), "expected words with and, or, not and parentheses");
}

TEST(RunMany, FliesNothingIfOneScenarioIsWrong) {
  const std::string folder = two_scenarios(), out = scratch("nothing");
  std::ofstream(folder + "/wrong.toml") << "title = \"wrong\"\nduration_s = 3\n";
  expect_one_line(hil_bench(fmt::format("run {} --bus in-process --out {}", folder, out)), "wrong.toml");
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(hil_bench(fmt::format("run {} --bus in-process -k 'not wrong'", folder)).code, 1)
      << "what is not selected may be wrong";
  fs::remove(folder + "/wrong.toml");
  std::ofstream(folder + "/misspelt.toml") << "title = \"misspelt\"\nduration = 3\n[target]\n";
  expect_one_line(hil_bench(fmt::format("run {} --bus in-process", folder)), "misspelt.toml");
  fs::remove(folder + "/misspelt.toml");
  const std::string both = fmt::format("run {0}/good.toml {0}/below --bus in-process ", folder);
  for (const std::string option : {"--json x.json", "--html x.html", "--csv x.csv", "--log x.log"})
    expect_one_line(hil_bench(both + option),
                    "is one file, and there are several scenarios, expected --out FOLDER");
  expect_one_line(hil_bench(both + "--tui"), "expected one scenario");
  expect_one_line(hil_bench(fmt::format("run {} --bus vcan0 -j 2", folder)), "would share --bus 'vcan0'");
  expect_one_line(hil_bench(fmt::format("run {} --target none -j 2", folder)), "would share --bus 'local:'");
  expect_one_line(hil_bench(fmt::format("run {0}/good.toml {0}/good.toml --bus in-process", folder)),
                  "expected each scenario once");
  fs::create_directories(scratch("empty"));
  expect_one_line(hil_bench("run " + scratch("empty")),
                  "has no scenario, expected a TOML file with duration_s");
}

TEST(RunMany, ARunThatCannotFlyIsNamedAndTheOthersFly) {
  const std::string folder = two_scenarios(), junit = scratch("ends.xml");
  const Ended ended =
      hil_bench(fmt::format("run {} -j 2 --lockstep --target false --junit {}", folder, junit));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.out, HasSubstr("\n2 could not fly\n"));
  EXPECT_THAT(ended.out, HasSubstr("ERROR"));
  EXPECT_THAT(read(junit),
              testing::ContainsRegex("tests=\"1\" failures=\"1\"(.|\n)*tests=\"1\" failures=\"1\""));
}

TEST(RunMany, AnInterruptionEndsAll) {
  const std::string folder = two_scenarios();
  const Ended ended = shell(fmt::format("timeout -s TERM 1.5 {} run {} -j 2", HIL_BENCH, folder));
  EXPECT_THAT(ended.err, HasSubstr("interrupted"));
  EXPECT_THAT(ended.out, Not(HasSubstr("PASS")));
}

}  // namespace
}  // namespace canhil::test
