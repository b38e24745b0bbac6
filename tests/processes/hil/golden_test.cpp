// Tests that hil-bench golden names the first answer that differs from the recorded answers.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class Golden : public testing::Test {
 protected:
  Golden() {
    fs::remove_all(folder_);
    const Ended ended = record(scenario("transfer_alignment_quick") + " " + scenario("los_quick"));
    EXPECT_EQ(ended.code, 0) << ended.err;
  }
  [[nodiscard]] Ended record(const std::string& more) const {
    return hil_bench(fmt::format("golden record {} {}", folder_, more));
  }
  [[nodiscard]] Ended check(const std::string& more = "") const {
    return hil_bench(fmt::format("golden check {} {}", folder_, more));
  }
  /// Changes a line of a stored scenario, so that the bench sends other frames than in the recorded run.
  void change(const std::string& name, const std::string& line, const std::string& instead) const {
    edit(fmt::format("{}/{}.toml", folder_, name), line, instead);
  }

  const std::string folder_ = scratch("golden");
};

TEST_F(Golden, TheSameTargetAnswersTheSame) {
  const Ended ended = check();
  EXPECT_EQ(ended.code, 0) << ended.out;
  EXPECT_TRUE(std::regex_search(ended.out, std::regex("PASS +los_quick +[0-9]{3,} frames as recorded")))
      << ended.out;
  EXPECT_TRUE(std::regex_search(ended.out, std::regex("PASS +transfer_alignment_quick +[0-9]{3,} frames")));
}

TEST_F(Golden, NamesTheFirstSignalThatLeftItsToleranceAndKeepsTheFrames) {
  change("transfer_alignment_quick", "velocity_noise_m2ps = 0.00025", "velocity_noise_m2ps = 0.00026");
  const std::string report = scratch("golden.json");
  const Ended ended = check("--json " + report);
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_TRUE(std::regex_search(
      ended.out,
      std::regex(
          "FAIL +transfer_alignment_quick +at t=[0-9.]+ s after [0-9]+ frames: Align[A-Za-z]+[.][a-z_]+ is "
          "[-0-9.e]+ in one, [-0-9.e]+ in the other; all frames in ")))
      << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("PASS  los_quick"));
  EXPECT_TRUE(fs::exists(folder_ + "/transfer_alignment_quick.check.log"));
  const nlohmann::json results = read_json(report);
  EXPECT_EQ(results[0]["outcome"], "pass");
  EXPECT_EQ(results[1]["outcome"], "fail");
  // With a wide tolerance, the changed answers are accepted as equal; with a narrow tolerance, they are not.
  EXPECT_EQ(check("--tolerance 1").code, 1);
  EXPECT_EQ(check("--tolerance 1000000").code, 0);
}

// A tolerance is for values: a counter and the validity of a CRC must be as recorded.
TEST_F(Golden, ACounterOrACrcThatDiffersIsADifference) {
  const std::string target = scratch("liar.sh"), lies = LYING_TARGET;
  const auto checked_against = [&](const std::string& lie) {
    std::ofstream(target) << fmt::format("#!/bin/sh\nexec {} {} \"$@\"\n", lies, lie);
    fs::permissions(target, fs::perms::owner_all);
    return check(fmt::format("--tolerance 1000000 --target {}", target));
  };
  const Ended jumped = checked_against("counters_jump");
  EXPECT_EQ(jumped.code, 1) << jumped.out;
  EXPECT_THAT(jumped.out, HasSubstr("LosRateEstimate.e2e_counter is 1 in one, 2 in the other"));
  const Ended damaged = checked_against("sigma_with_wrong_crc");
  EXPECT_EQ(damaged.code, 1) << damaged.out;
  EXPECT_THAT(damaged.out, HasSubstr("LosRateSigma.e2e_crc is right in one, wrong in the other"));
  const Ended diverged = hil_bench(fmt::format("diverge {0}/los_quick.log {0}/los_quick.check.log", folder_));
  EXPECT_EQ(diverged.code, 1);
  EXPECT_THAT(diverged.out, HasSubstr("e2e_counter=0 (wrong CRC) los_rate_sigma_pitch_radps="));
}

TEST_F(Golden, AScenarioWithAMappingIsRefused) {
  const std::string file = SOURCE_DIR "/docs/examples/own_ecu/own_ecu.toml";
  expect_one_line(record(file), "own_ecu.toml: has a mapping");
  fs::copy_file(file, folder_ + "/own_ecu.toml");
  EXPECT_EQ(check().code, 2);
}

TEST_F(Golden, ATargetThatGivesUpIsAFailure) {
  const Ended ended = check("--target /usr/bin/true");
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("FAIL  los_quick"));
}

// A log contains classic frames even if the bus was CAN FD. Therefore the test finds out from the target's
// command line which kind of bus was used.
TEST_F(Golden, AScenarioOnCanFdIsFlownOnCanFd) {
  const std::string file = scratch("on_fd.toml"), target = scratch("started_target.sh"),
                    arguments = scratch("arguments.txt");
  std::ofstream(file) << "dbc = \"canhil-fd\"\n" << read(scenario("los_quick"));
  std::ofstream(target) << fmt::format("#!/bin/sh\necho \"$@\" > {}\nexec {} \"$@\"\n", arguments,
                                       HIL_TARGET);
  fs::permissions(target, fs::perms::owner_all);
  const Ended ended = record(fmt::format("{} --target {}", file, target));
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(std::regex_match(read(arguments), std::regex("--bus local:[^ ]+ --dbc canhil-fd\n")))
      << read(arguments);
  EXPECT_EQ(check().code, 0);
}

// A stored scenario that cannot be read is bad input, not a failure of the target: no scenario is flown.
TEST_F(Golden, AKeptScenarioThatIsBrokenIsBadInput) {
  change("transfer_alignment_quick", "velocity_noise_m2ps", "velocity_noise");
  expect_one_line(check(), "transfer_alignment_quick.toml:");
  std::ofstream(folder_ + "/los_quick.toml") << "no = toml = at all\n";
  expect_one_line(check(), "los_quick.toml:1: not TOML");
}

TEST_F(Golden, BadInputIsOneLine) {
  expect_one_line(record(scenario("los_quick")), "los_quick.log: exists already");
  expect_one_line(record("none.toml"), "none.toml: cannot be read");
  expect_one_line(hil_bench(fmt::format("golden record {0}/new {1} {1}", folder_, scenario("los_quick"))),
                  "is named twice");
  expect_one_line(hil_bench("golden check /no/such/folder"), "/no/such/folder: cannot be read");
  fs::create_directories(folder_ + "/empty");
  expect_one_line(hil_bench(fmt::format("golden check {}/empty", folder_)), "has no scenario");
  expect_one_line(hil_bench("golden"), "golden");
  expect_one_line(check("--tolerance -1"), "--tolerance");
  expect_one_line(check("--target /no/such/program"), "'/no/such/program': is not a program");
  EXPECT_FALSE(fs::exists(folder_ + "/none.log"));
}

}  // namespace
}  // namespace canhil::test
