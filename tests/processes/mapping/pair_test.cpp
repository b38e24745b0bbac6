// Two ECUs on one bus, each with a DBC and a mapping of its own: docs/examples/pair.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class Pair : public testing::Test {
 protected:
  Pair() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    for (const char* example : {"pair", "own_ecu"})
      fs::copy(fmt::format("{}/docs/examples/{}", SOURCE_DIR, example),
               fmt::format("{}/{}", folder_, example));
  }
  static std::string ecu(const std::string& defect, const std::string& more = "") {
    return fmt::format("--target '/usr/bin/python3 " SOURCE_DIR
                       "/tests/processes/mapping/defective_ecu.py {}{}' ",
                       defect, more);
  }
  [[nodiscard]] Ended fly(const std::string& left, const std::string& right, const std::string& more) const {
    return hil_bench(fmt::format("run {}/pair/pair.toml {} {} {} --json {}", folder_, ecu(left),
                                 ecu(right, " --answers 0x210"), more, report()));
  }
  [[nodiscard]] std::string report() const { return folder_ + "/pair.json"; }
  // The names of the checks that fail.
  [[nodiscard]] std::vector<std::string> failed() const {
    std::vector<std::string> names;
    const nlohmann::json seen = read_json(report());
    for (const auto& check : seen["checks"]) {
      if (check["outcome"] == "fail") names.push_back(check["name"]);
    }
    return names;
  }
  const std::string folder_ = scratch("pair");
};

TEST_F(Pair, EachAnswersTheSameSamples) {
  const Ended ended = fly("none", "none", "--lockstep");
  EXPECT_EQ(ended.code, 3) << ended.err << ended.out;
  EXPECT_THAT(failed(), testing::IsEmpty()) << ended.out;
  const nlohmann::json seen = read_json(report());
  EXPECT_EQ(figure(seen, "own_ecu", "answers", "ECU_Attitude"), 1200);
  EXPECT_EQ(figure(seen, "right", "answers", "right.ECU_Attitude"), 1200);
}

TEST_F(Pair, AreJudgedInRealTimeToo) {
  Ended ended = fly("none", "none", "--bus " + bus());
  ASSERT_NE(ended.code, 2) << ended.err;
  expect_outputs_passed(ended, read_json(report()));
}

TEST_F(Pair, OneThatIsWrongFailsItsOwnChecks) {
  EXPECT_EQ(fly("none", "wrong_sign", "--lockstep").code, 1);
  EXPECT_THAT(failed(), testing::Contains("error attitude.pitch of right"));
  EXPECT_THAT(failed(), testing::Each(HasSubstr("right")));
  EXPECT_EQ(fly("stale", "none", "--lockstep").code, 1);
  EXPECT_THAT(failed(), testing::Contains("delay attitude.roll of own_ecu"));
  EXPECT_THAT(failed(), testing::Each(HasSubstr("own_ecu")));
}

TEST_F(Pair, OneThatIsSilentFailsThoughTheOtherAnswers) {
  EXPECT_EQ(fly("none", "silent", "--bus " + bus()).code, 1);
  EXPECT_THAT(failed(), testing::Contains(HasSubstr("of right")));
}

TEST_F(Pair, OneThatIsMissingFails) {
  const Ended ended =
      hil_bench(fmt::format("run {}/pair/pair.toml {} --json {}", folder_, ecu("none"), report()));
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(failed(), testing::Contains("answers answers of right"));
}

TEST_F(Pair, OneThatEndsIsNamed) {
  const Ended ended =
      hil_bench(fmt::format("run {}/pair/pair.toml {} --target /bin/false", folder_, ecu("none")));
  expect_one_line(ended, "target '/bin/false': exited with 1");
}

TEST_F(Pair, WhatCannotBeOnOneBusIsOneLine) {
  const auto refused = [&](const std::string& name, const std::string& one, const std::string& other,
                           const std::string& because) {
    const std::string path = folder_ + "/pair/" + name, before = read(path);
    edit(path, one, other);
    expect_one_line(hil_bench(fmt::format("run {}/pair/pair.toml --target none", folder_)), because);
    std::ofstream(path) << before;
  };
  refused(
      "right.mapping.toml", "\"-imu.rate.z\"", "\"imu.rate.z\"",
      "right.mapping.toml: IMU_TX1 is sent to another target with other values or at other times, expected "
      "the same play in both mappings");
  refused("pair.toml", "\"right.mapping.toml\"", "\"../own_ecu/own_ecu.mapping.toml\"",
          "key 'target[2].mapping': 'own_ecu' is the name of another [[target]] too, expected a mapping with "
          "another 'name'");
  expect_one_line(
      hil_bench(fmt::format("run {}/pair/pair.toml {}{}{}", folder_, ecu("none"), ecu("none"), ecu("none"))),
      "--target: is given 3 times, expected at most 2, as");
  expect_one_line(hil_bench(fmt::format("run {}/pair/pair.toml {}--target none", folder_, ecu("none"))),
                  "--target none: is given beside a program, expected only one of the two");
}

}  // namespace
}  // namespace canhil::test
