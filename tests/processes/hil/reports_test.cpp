// Tests the commands of hil-bench that read reports of finished runs.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// All tests use the reports of one run in virtual time, whose results are the same on any host.
class Reports : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Ended run = hil_bench("run " + scenario("transfer_alignment_quick") + " --bus in-process --json " +
                                scratch("one.json") + " --html " + scratch("one.html"));
    ASSERT_THAT(run.err, testing::IsEmpty());
  }
  static std::string altered(const std::string& name, const auto& alter) {
    nlohmann::ordered_json report = nlohmann::ordered_json::parse(read(scratch("one.json")));
    alter(report);
    std::ofstream(scratch(name)) << report;
    return scratch(name);
  }
};

TEST_F(Reports, ThePageIsMadeAgainFromTheJson) {
  const std::string first = read(scratch("one.html"));
  EXPECT_THAT(first, StartsWith("<!doctype html>"));
  std::ofstream(scratch("one.html")) << "gone";
  const Ended ended = hil_bench("report " + scratch("one.json"));
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, scratch("one.html") + "\n");
  EXPECT_EQ(read(scratch("one.html")), first);
}

TEST_F(Reports, TellWhichTargetWasTested) {
  EXPECT_EQ(read_json(scratch("one.json"))["provenance"]["target"]["program"], "in hil-bench itself");
  const Ended run = hil_bench("run " + scenario("transfer_alignment_quick") + " --bus " + bus() +
                              " --lockstep --json " + scratch("target.json"));
  ASSERT_THAT(run.err, testing::IsEmpty());
  const nlohmann::json provenance = read_json(scratch("target.json"))["provenance"];
  const nlohmann::json& target = provenance["target"];
  EXPECT_THAT(target["program"].get<std::string>(), EndsWith("/hil-target"));
  std::map<std::string, nlohmann::json> files;
  for (const auto& file : provenance["files"]) files[file["role"]] = file;
  EXPECT_EQ(files["target"]["bytes"].get<std::uintmax_t>(),
            std::filesystem::file_size(target["program"].get<std::string>()));
}

// The hashes must equal those of sha256sum; the hash of the built-in DBC must equal that of dbc/canhil.dbc.
TEST_F(Reports, NameEveryFileByItsHash) {
  const Ended run = hil_bench("run " + scenario("transfer_alignment_quick") + " --bus " + bus() +
                              " --lockstep --operator 'Ada L' --json " + scratch("signed.json"));
  const auto provenance = read_json(scratch("signed.json"))["provenance"];
  EXPECT_EQ(provenance["operator"], "Ada L");
  std::vector<std::string> roles;
  for (const auto& file : provenance["files"]) {
    roles.push_back(file["role"]);
    const std::string name =
        file["role"] == "DBC" ? SOURCE_DIR "/dbc/canhil.dbc" : file["name"].get<std::string>();
    EXPECT_EQ(shell("sha256sum " + name).out.substr(0, 64), file["sha256"]) << name;
  }
  EXPECT_THAT(roles, testing::ElementsAre("bench", "target", "scenario", "DBC"));
  EXPECT_EQ(provenance["adapters"][0]["kind"], "virtual");
  expect_one_line(hil_bench("run " + scenario("transfer_alignment_quick") +
                            " --bus in-process --operator \"$(printf '\\t')\""),
                  "--operator: holds a control character");
}

TEST_F(Reports, TheSameIsNoWorse) {
  const Ended ended = hil_bench("compare " + scratch("one.json") + " " + scratch("one.json"));
  EXPECT_EQ(ended.code, 0) << ended.out;
  EXPECT_THAT(ended.out, EndsWith("no worse\n"));
}

TEST_F(Reports, ACheckThatFailsNowIsWorse) {
  const std::string worse =
      altered("worse.json", [](auto& report) { report["checks"][0]["outcome"] = "fail"; });
  const Ended ended = hil_bench("compare " + scratch("one.json") + " " + worse);
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.out, EndsWith("worse\n"));
  EXPECT_EQ(hil_bench("compare " + worse + " " + scratch("one.json")).code, 0);
}

TEST_F(Reports, AnotherScenarioIsNotComparable) {
  const std::string other =
      altered("other.json", [](auto& report) { report["provenance"]["scenario_hash"] = "0"; });
  const Ended ended = hil_bench("compare " + scratch("one.json") + " " + other);
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.out, StartsWith("not comparable: the scenario differs"));
}

TEST_F(Reports, WhatIsNoReportIsRefusedInOneLine) {
  std::ofstream(scratch("torn.json")) << "{\"schema\"";
  const std::string hollow = altered("hollow.json", [](auto& report) { report.erase("checks"); });
  const std::vector<std::string> wrong{"report " + scratch("torn.json"),
                                       "report " + hollow,
                                       "report /no/such.json",
                                       "report " + scratch("one.json") + " " + scratch("one.json"),
                                       "compare " + scratch("one.json") + " " + scratch("torn.json"),
                                       "compare " + hollow + " " + scratch("one.json"),
                                       "compare /no/a.json /no/b.json"};
  for (const std::string& arguments : wrong) {
    const Ended ended = hil_bench(arguments);
    EXPECT_EQ(ended.code, 2) << arguments;
    EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
    EXPECT_THAT(ended.err, StartsWith("hil-bench: "));
  }
}

TEST_F(Reports, ARunThatCountsTwiceIsRefused) {
  const std::string one = scratch("one.json");
  std::filesystem::copy_file(one, scratch("other.json"), std::filesystem::copy_options::overwrite_existing);
  for (const std::string& sides : {"--before " + one + " " + one + " --after " + scratch("other.json"),
                                   "--before " + scratch("other.json") + " --after " + one + " " + one})
    expect_one_line(hil_bench("compare " + sides), "one.json': is named twice");
}

TEST_F(Reports, WhatIsWrongInAReportIsNamedWithItsFileAndKey) {
  const std::string odd = altered("odd.json", [](auto& report) { report["checks"][0]["kind"] = 5; });
  const std::string said = "file '" + odd + "': key 'checks[0].kind': is 5, expected text";
  expect_one_line(hil_bench("report " + odd), said);
  expect_one_line(hil_bench("compare " + scratch("one.json") + " " + odd), said);
}

TEST_F(Reports, APageStandsBesideAFileAndInNoLinksPlace) {
  expect_one_line(shell(fmt::format("cat {} | {} report /dev/stdin", scratch("one.json"), HIL_BENCH)),
                  "file '/dev/stdin': is not a regular file");
  const std::string linked = altered("linked.json", [](auto&) {});
  std::filesystem::create_symlink("elsewhere", scratch("linked.html"));
  expect_one_line(hil_bench("report " + linked), "linked.html': is not a regular file");
  EXPECT_TRUE(std::filesystem::is_symlink(scratch("linked.html")));
  std::filesystem::remove(scratch("linked.html"));
}

TEST_F(Reports, APageThatCannotBeWrittenIsRejectedBeforeTheRun) {
  const Ended ended =
      hil_bench("run " + scenario("transfer_alignment_quick") + " --bus in-process --html /no/such/a.html");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("'/no/such/a.html'"));
}

}  // namespace
}  // namespace canhil::test
