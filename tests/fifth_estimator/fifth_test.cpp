// A fifth estimator end to end: target, node, scenario, campaign, report.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

std::string here(const std::string& name) { return SOURCE_DIR "/tests/fifth_estimator/" + name; }

/// height.toml with one line replaced.
std::string with(const std::string& line, const std::string& instead) {
  std::string text = read(here("height.toml"));
  const auto at = text.find(line);
  if (at == std::string::npos) ADD_FAILURE() << "height.toml has no line " << line;
  std::string file = scratch("changed.toml");
  std::ofstream(file) << text.replace(at, line.size(), instead);
  return file;
}

TEST(FifthEstimator, PassesItsScenarioBehindTheBusWithTheBitsOfOneInProcess) {
  const std::string report = scratch("height.json"), log = scratch("bus.log"),
                    in_process = scratch("process.log");
  const Ended ended = hil_bench(
      fmt::format("run {} --bus {} --lockstep --json {} --log {}", here("height.toml"), bus(), report, log));
  EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_EQ(hil_bench(fmt::format("run {} --bus in-process --log {}", here("height.toml"), in_process)).code,
            0);
  EXPECT_TRUE(target_frames(log) == target_frames(in_process));
  EXPECT_LT(std::abs(figure(read_json(report), "baro_inertial", "final_error", "height")), 1.0);
}

TEST(FifthEstimator, ItsQuantitiesAreDrawnAndExported) {
  const std::string page = scratch("height.html"), table = scratch("height.csv");
  EXPECT_EQ(
      hil_bench(fmt::format("run {} --bus in-process --html {} --csv {}", here("height.toml"), page, table))
          .code,
      0);
  const std::string html = read(page);
  for (const char* title : {"height error", "velocity error down", "normalised innovation squared"})
    EXPECT_THAT(html, HasSubstr(title));
  EXPECT_THAT(read(table), HasSubstr("height.nis"));
}

TEST(FifthEstimator, ItsDefectsFail) {
  // With a gate that rejects every height, the target answers the heights but does not use them.
  const Ended gated = hil_bench(
      fmt::format("run {} --bus in-process", with("fix_noise_vertical_m = 2.0", "gate_nis = 1e-9")));
  EXPECT_EQ(gated.code, 1) << gated.out;
  EXPECT_TRUE(std::regex_search(gated.out, std::regex("FAIL +answers"))) << gated.out;
  // If the filter assumes a fifth of the true barometer noise, the NIS is too large.
  const Ended sure = hil_bench(fmt::format("run {} --bus in-process",
                                           with("fix_noise_vertical_m = 2.0", "fix_noise_vertical_m = 0.4")));
  EXPECT_EQ(sure.code, 1) << sure.out;
  EXPECT_TRUE(std::regex_search(sure.out, std::regex("FAIL +consistency"))) << sure.out;
  // The barometer drifts by 3 m in the last minute, and the estimate follows it.
  const std::string spread = "[[check]] # docs/adding-a-check.md";
  const Ended drifting = hil_bench(fmt::format(
      "run {} --bus in-process",
      with(spread,
           "[[fault]]\nkind = \"drift\"\nquantity = \"barometer.height\"\nby_m = 0.05\nfrom_s = 30.0\n" +
               spread)));
  EXPECT_EQ(drifting.code, 1) << drifting.out;
  EXPECT_TRUE(std::regex_search(drifting.out, std::regex("FAIL +spread"))) << drifting.out;
}

TEST(FifthEstimator, BadInputOfItsOwnIsOneLine) {
  expect_one_line(hil_bench(fmt::format("run {} --bus in-process",
                                        with("quantity = \"height\"", "quantity = \"hight\""))),
                  "'height'");
  expect_one_line(hil_bench(fmt::format("run {} --bus in-process", with("[barometer]\nnoise_m = 2.0", ""))),
                  "key 'barometer': is missing");
  expect_one_line(hil_bench(fmt::format("run {} --bus in-process", with("noise_m = 2.0", "noise_m = 200"))),
                  "barometer.noise_m");
}

TEST(FifthEstimator, ACampaignJudgesItsHonesty) {
  const std::string folder = scratch("campaign");
  const Ended ended =
      hil_bench(fmt::format("campaign {} --out {} --threads 2", here("heights.toml"), folder));
  EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("height.nees"));
}

// The kind of docs/adding-a-check.md is one file and a line, and works wherever a check can stand.
TEST(FifthEstimator, ItsCheckWorksInAScenarioACampaignAndASuite) {
  namespace fs = std::filesystem;
  const std::string folder = scratch("spread");
  fs::create_directories(folder + "/suite");
  const auto outcomes = [&](double below_m) {
    const std::string table = fmt::format(
        "[[check]]\nname = 'mine'\nrequirement = 'S-1'\nkind = 'spread'\nquantity = 'height'\nfrom_s = 30.0\n"
        "below_m = {}\n",
        below_m);
    std::string flight = read(here("height.toml"));
    const std::string whole = "duration_s = 90.0";
    flight.replace(flight.find(whole), whole.size(), "duration_s = 40.0");
    std::ofstream(folder + "/flight.toml") << flight.substr(0, flight.find("[[check]]")) << table;
    std::ofstream(folder + "/campaign.toml")
        << "title = 'C'\nruns = 3\nseed = 3\n[[variant]]\nname = 'V'\nscenario = 'flight.toml'\n"
        << table;
    std::ofstream(folder + "/suite/suite.toml")
        << "title = 'S'\nestimator = 'baro_inertial'\n"
           "[[requirement]]\nid = 'S-1'\nfamily = 'errors'\ntext = 'The error of the height stays within a "
           "range.'\n"
           "[[flight]]\nname = 'F'\nscenario = '../flight.toml'\nrequirement = 'S-1'\n"
           "[[campaign]]\nfile = '../campaign.toml'\n";
    const Ended run = hil_bench(fmt::format("run {}/flight.toml --bus in-process --json -", folder));
    const Ended campaign = hil_bench(fmt::format("campaign {0}/campaign.toml --out {0} --json -", folder));
    const Ended suite = hil_bench(fmt::format(
        "accept --estimator baro_inertial --suites {} --target '{}' --json -", folder, HIL_TARGET));
    fs::remove(folder + "/campaign.sqlite");
    std::vector<std::string> found{json_of(run.out)["checks"][0]["outcome"],
                                   json_of(campaign.out)["answers"][0]["outcome"]};
    const auto suites = json_of(suite.out)["suites"];
    for (const auto& item : suites[0]["requirements"][0]["items"]) {
      if (item["kind"] == "spread") found.push_back(item["outcome"]);
    }
    return found;
  };
  using testing::ElementsAre;
  EXPECT_THAT(outcomes(100), ElementsAre("pass", "pass", "pass", "pass"))
      << "run, campaign, flight and campaign of the suite";
  EXPECT_THAT(outcomes(0.001), ElementsAre("fail", "fail", "fail", "fail"));
}

}  // namespace
}  // namespace canhil::test
