// Tests hil-bench accept as a user starts it, with a small suite for this test and with a suite of the
// project.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

constexpr std::string_view suite = R"(title = "A small suite"
estimator = "transfer_alignment"
dialogue = "flight.toml"

[[requirement]]
id = "S-1"
family = "errors"
text = "The flight is flown."

[[requirement]]
id = "S-2"
family = "algorithms"
text = "The answers are the reference's."

[[requirement]]
id = "S-3"
family = "parameters"
text = "The noise has its effect."

[[requirement]]
id = "S-4"
family = "flags and states"
text = "Silence is a fault."

[[flight]]
name = "one"
scenario = "flight.toml"
requirement = "S-1"
reference = "S-2"

[[flight]]
name = "less sure"
scenario = "flight.toml"
set = { "target.parameters.velocity_noise_m2ps" = 0.01 }
requirement = "S-3"
beside = "one"
moves = { signal = "AlignUpdate.nis", to = "less" }

[[flight]]
name = "silent"
scenario = "flight.toml"
set = { "fault" = [{ kind = "lost", messages = ["SlaveImuDeltaTheta", "SlaveImuDeltaV", "SlaveImuStatus"], from_s = 1.0 }] }
requirement = "S-4"
faults = true

[[parameter]]
name = "h2_case"
least = 1
most = 4
whole = true
)";

class Accept : public testing::Test {
 protected:
  Accept() {
    fs::remove_all(folder_);
    fs::create_directories(folder_ + "/small");
    std::ofstream(folder_ + "/small/suite.toml") << suite;
    // A flight of three seconds. Its scenario has only one check, because the suite contains the
    // requirements.
    std::string flight = read(scenario("transfer_alignment_quick"));
    flight.resize(flight.find("[[check]]"));
    std::ofstream(folder_ + "/small/flight.toml")
        << flight << "[[check]]\nkind = \"answers\"\nanswers_at_least = 200\n";
  }
  [[nodiscard]] Ended accept(const std::string& more) const {
    return hil_bench(fmt::format("accept --suites {} {}", folder_, more));
  }
  void change(const std::string& file, const std::string& was, const std::string& is) const {
    edit(folder_ + "/small/" + file, was, is);
  }

  const std::string folder_ = scratch("suites");
  static constexpr const char* judged =
      "--family errors --family algorithms --family 'flags and states' --family protocol";
};

TEST_F(Accept, ATargetThatMeetsEveryRequirementPasses) {
  const std::string json = scratch("accept.json"), junit = scratch("accept.xml"),
                    page = scratch("accept.html");
  const Ended ended = accept(
      fmt::format("{} --same-as hil-target --json {} --junit {} --html {}", judged, json, junit, page));
  EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("PASS          S-2"));
  EXPECT_THAT(ended.out, HasSubstr("PASS          P-STOP"));
  const auto report = read_json(json);
  EXPECT_EQ(report["outcome"], "pass");
  EXPECT_EQ(report["same_as"], "hil-target");
  const std::size_t asked = report["suites"][0]["requirements"].size();
  EXPECT_GT(asked, 20U);  // includes the suite's own requirements and those of the protocol
  EXPECT_THAT(ended.out,
              HasSubstr(fmt::format("transfer_alignment: pass: {0} of {0} requirements met", asked)));
  EXPECT_EQ(shell("xmllint --noout " + junit).code, 0);
  EXPECT_THAT(read(page), HasSubstr("Silence is a fault."));
}

// Whether a target is good, and whether it is the same as hil-target, are two questions.
TEST_F(Accept, AnAnswerThatIsNotHilTargetsIsNamedIfThisIsAsked) {
  const std::string other = fmt::format("--target '{} heading_off'", LYING_TARGET);
  const Ended ended = accept(other + " --family algorithms --same-as hil-target");
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("FAIL          S-2"));
  EXPECT_THAT(ended.out, HasSubstr("flight 'one' as the reference: AlignAttitude.heading_deg"));
  EXPECT_EQ(accept(other + " --family algorithms --same-as hil-target --tolerance 1000").code, 0);

  const Ended good = accept(other + " --family errors --family algorithms");
  EXPECT_EQ(good.code, 0) << good.out;
  EXPECT_THAT(good.out, Not(HasSubstr("S-2"))) << "no test of it was asked";
}

// A target that is not there is found at once, and by one line; earlier reports stay.
TEST_F(Accept, ATargetThatDoesNotAnswerIsNoTarget) {
  const std::string html = scratch("page.html");
  std::ofstream(html) << "of an earlier acceptance";
  for (const char* target : {"/bin/false", "sh -c 'exit 3'"}) {
    expect_one_line(accept(fmt::format("--family errors --target \"{}\" --html {}", target, html)),
                    "before its first heartbeat");
  }
  EXPECT_EQ(read(html), "of an earlier acceptance");
  EXPECT_EQ(accept("--family errors --html " + html).code, 0);
  EXPECT_THAT(read(html), HasSubstr("Provenance"));
}

// A flight in virtual time does not measure the timing, so a requirement about nothing else is not met.
TEST_F(Accept, AFlightWhoseChecksAreOnlyOfTimingMeasuresNothing) {
  std::ofstream(folder_ + "/small/suite.toml", std::ios::app) << R"(
[[flight]]
name = "fast"
scenario = "flight.toml"
set = { "check" = [{ kind = "latency", message = "AlignUpdate", below_ms = 5, quantile = 0.5 }] }
requirement = "S-1"
)";
  EXPECT_EQ(accept("--family errors").code, 3);
}

// What a requirement needs is flown although the flight itself belongs to another family.
TEST_F(Accept, AResponseIsFlownForItsOwnFamily) {
  change("suite.toml", "requirement = \"S-3\"\nbeside", "requirement = \"S-1\"\nresponse = \"S-3\"\nbeside");
  const Ended ended = accept("--family parameters");
  EXPECT_THAT(ended.out, HasSubstr("PASS          S-3"));
}

TEST_F(Accept, AComparisonNeedsSomethingToCompare) {
  change("suite.toml", "reference = \"S-2\"\n", "");
  expect_one_line(accept("--same-as hil-target"), "no flight of the suites in");
}

TEST_F(Accept, AMoveToTheOtherSideFails) {
  change("suite.toml", "to = \"less\"", "to = \"more\"");
  const Ended ended = accept("--family parameters");
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.out, HasSubstr("flight 'less sure': AlignUpdate.nis: mean magnitude"));
}

// The noise is the same in both flights, so the difference is the response to the master's velocity.
TEST_F(Accept, AResponseWithTheWrongSignFails) {
  std::ofstream(folder_ + "/small/suite.toml", std::ios::app) << R"(
[[flight]]
name = "faster"
scenario = "flight.toml"
set = { "fault" = [{ kind = "bias", quantity = "master_ins.velocity_north", by_mps = 1.0, from_s = 0 }] }
requirement = "S-1"
beside = "one"
moves = [
  { signal = "AlignVelocityNE.velocity_north_mps", by = [0.8, 1.05] },
  { signal = "AlignVelocityNE.velocity_east_mps", by = [-0.05, 0.05] },
]
)";
  const Ended right = accept("--family errors");
  EXPECT_EQ(right.code, 0) << right.out << right.err;
  change("suite.toml", "[0.8, 1.05]", "[-1.05, -0.8]");
  const Ended wrong = accept("--family errors");
  EXPECT_EQ(wrong.code, 1);
  EXPECT_THAT(wrong.out, HasSubstr("flight 'faster': AlignVelocityNE.velocity_north_mps: differs by 0."));
  EXPECT_THAT(wrong.out, HasSubstr("-1.05 to -0.8 m/s from flight 'one'"));
}

TEST_F(Accept, AFaultThatDoesNotComeFails) {
  change("suite.toml", "from_s = 1.0", "from_s = 2.95");  // so late that the target cannot detect a silence
  ASSERT_EQ(accept("--family protocol").code, 0);
  const Ended ended = accept("--family 'flags and states'");
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(
      ended.out,
      HasSubstr("flight 'silent' ends: a flight to its end; expected a heartbeat that reports a fault"));
}

TEST_F(Accept, ARangeThatIsNotTheTargetsFails) {
  change("suite.toml", "most = 4", "most = 5");
  const Ended ended = accept("--family parameters");
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.out, HasSubstr("h2_case = 5: out_of_range"));
}

TEST_F(Accept, StopsAtTheFirstFailureWhenAskedTo) {
  const Ended ended =
      accept(fmt::format("--target '{} heading_off' --same-as hil-target --first-failure", LYING_TARGET));
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.out, HasSubstr("NOT REACHED   S-4"));
}

TEST_F(Accept, BadInputIsOneLine) {
  expect_one_line(accept("--target /no/such/program"), "target '/no/such/program': is not a program");
  expect_one_line(accept("--estimator winds"), "--estimator 'winds': has no suite in");
  expect_one_line(accept("--family error"), "--family 'error': is unknown, expected one of: errors");
  expect_one_line(accept("--tolerance 0"), "--tolerance");
  expect_one_line(accept("--html /no/such/folder/a.html"), "/no/such/folder/a.html");
  expect_one_line(hil_bench("accept --suites /no/such/folder"), "/no/such/folder: has no suites");
  expect_one_line(accept("--same-as other"), "--same-as 'other': is unknown, expected hil-target");
  expect_one_line(accept("--tolerance 2"), "expected --same-as hil-target too");
  change("suite.toml", "family = \"errors\"", "family = \"error\"");
  expect_one_line(accept(""), "small/suite.toml:7: key 'requirement[1].family'");
}

// If the bench cannot store the results of a campaign, for example because the disk is full, it must not
// report this as a defect of the target.
TEST_F(Accept, ACampaignWhoseResultsCannotBeKeptIsNoFailureOfTheTarget) {
  std::ofstream(folder_ + "/small/suite.toml", std::ios::app) << "\n[[campaign]]\nfile = \"campaign.toml\"\n";
  std::ofstream(folder_ + "/small/campaign.toml") << R"(title = "Two flights"
runs = 2
seed = 1

[[variant]]
name = "quick"
scenario = "flight.toml"

[[metric]]
kind = "value_at"
name = "velocity north"
quantity = "velocity.north"
requirement = "S-1"
at_s = 2.9
at_most_mps = 100
)";
  const std::string flight =
      fmt::format("{} accept --suites {} --estimator transfer_alignment --family errors", HIL_BENCH, folder_);
  const Ended kept = shell(flight);
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_THAT(kept.out, HasSubstr("(3 tests"));  // 3 results: two of the flight, one of the campaign
  expect_one_line(shell("TMPDIR=/no/such/folder " + flight), "environment TMPDIR: expected a folder");
  expect_one_line(shell("TMPDIR=/proc " + flight), "/proc/canhil-accept");
}

// The unchanged target passes two families of requirements of the suite of los_rate: protocol and parameters.
TEST(Suites, ProtocolAndStatesOfTheTargetPass) {
  const Ended ended = hil_bench("accept --family protocol --family parameters --estimator los_rate");
  EXPECT_EQ(ended.code, 0) << ended.out;
  EXPECT_THAT(ended.out, Not(HasSubstr("NOT MEASURED")));
}

}  // namespace
}  // namespace canhil::test
