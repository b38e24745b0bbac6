// Tests hil-bench conformance: which targets pass it, and which rule detects which defect.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

std::string python(const std::string& script) { return "/usr/bin/python3 -B " SOURCE_DIR "/" + script; }

nlohmann::json conformance(const std::string& target, const std::string& more = "") {
  const Ended ended = hil_bench(fmt::format("conformance --target '{}' --json - {}", target, more));
  EXPECT_TRUE(ended.code == 0 || ended.code == 1) << ended.err;
  return json_of(ended.out);
}

std::set<std::string> broken(const nlohmann::json& report) {
  std::set<std::string> ids;
  for (const auto& rule : report["rules"]) {
    if (rule["outcome"] != "pass") ids.insert(rule["id"].get<std::string>());
  }
  return ids;
}

class Sound : public testing::TestWithParam<std::pair<const char*, std::string>> {};

TEST_P(Sound, TargetKeepsEveryRule) {
  const nlohmann::json report = conformance(GetParam().second);
  EXPECT_EQ(report["outcome"], "pass") << report.dump(1);
  EXPECT_GE(report["rules"].size(), 25U);
}

INSTANTIATE_TEST_SUITE_P(
    Conformance, Sound,
    testing::Values(std::pair("hil_target", std::string(HIL_TARGET)),
                    std::pair("kit_in_C", std::string(KIT_LOS_RATE)),
                    std::pair("kit_in_Python", python("docs/examples/kit/los_rate.py")),
                    std::pair("test_target_without_defect",
                              python("tests/processes/conformance/defective_target.py " SOURCE_DIR
                                     "/docs/examples/kit none"))),
    [](const auto& named) { return named.param.first; });

class EstimatorOfHilTarget : public testing::TestWithParam<const char*> {};

TEST_P(EstimatorOfHilTarget, KeepsEveryRule) {
  const nlohmann::json report = conformance(HIL_TARGET, fmt::format("--estimator {}", GetParam()));
  EXPECT_EQ(report["estimator"], GetParam());
  EXPECT_EQ(report["outcome"], "pass") << report.dump(1);
}

INSTANTIATE_TEST_SUITE_P(Conformance, EstimatorOfHilTarget,
                         testing::Values("transfer_alignment", "inflight_alignment", "los_rate", "wind"),
                         [](const auto& named) { return named.param; });

struct Defect {
  const char* name;                // a class of defective_target.py
  std::set<std::string> expected;  // exactly these rules must detect the defect
  friend void PrintTo(const Defect& defect, std::ostream* out) { *out << defect.name; }
};

class Defective : public testing::TestWithParam<Defect> {};

TEST_P(Defective, TargetIsNamedByItsRuleAlone) {
  const nlohmann::json report = conformance(
      python(fmt::format("tests/processes/conformance/defective_target.py {}/docs/examples/kit {}",
                         SOURCE_DIR, GetParam().name)));
  EXPECT_EQ(broken(report), GetParam().expected) << report.dump(1);
}

INSTANTIATE_TEST_SUITE_P(
    Conformance, Defective,
    testing::Values(
        Defect{"SlowBeat", {"P-BEAT"}}, Defect{"AnyContract", {"P-CONTRACT"}},
        Defect{"AnyEstimator", {"P-ESTIMATOR"}}, Defect{"UnknownCommand", {"P-COMMAND"}},
        // NoStateNeeded violates two rules: a target that starts without an initial state also
        // starts with an incomplete one.
        Defect{"NoStateNeeded", {"P-NO-STATE", "P-WHOLE-STATE"}}, Defect{"HalfState", {"P-WHOLE-STATE"}},
        Defect{"DeafToRepetition", {"P-REPEAT"}}, Defect{"EarlyAnswers", {"P-BEFORE"}},
        Defect{"NoStop", {"P-STOP"}}, Defect{"Once", {"P-AGAIN"}},
        Defect{"NewStateInFlight", {"P-IN-FLIGHT"}}, Defect{"Unforgetting", {"P-RESET"}},
        Defect{"NoCounters", {"P-BEAT-FLIGHT"}}, Defect{"EarlyStepDone", {"P-STEP"}},
        Defect{"WrongAnswerCrc", {"P-PROTECT"}}, Defect{"Disorder", {"P-GROUP"}},
        Defect{"OwnCause", {"P-CAUSE"}}, Defect{"Chance", {"P-REPLAY"}}, Defect{"NoWrap", {"P-WRAP"}},
        // P-COUNT fails too: this target does not detect damaged frames, so it does not count them.
        Defect{"AnyCrc", {"P-COUNT", "P-CRC"}}, Defect{"AnySize", {"P-SIZE"}},
        Defect{"Repetitions", {"P-TWICE"}}, Defect{"NoLosses", {"P-LOST"}}, Defect{"HalfSamples", {"P-HALF"}},
        Defect{"EightBits", {"P-COUNT"}}, Defect{"Parrot", {"P-READ-BACK"}},
        Defect{"AnyParameter", {"P-UNNAMED"}}, Defect{"KeptParameters", {"P-INITIAL"}}),
    [](const auto& named) { return named.param.name; });

// The bench ends the process after the last rule.
TEST(Conformance, AProcessThatCrashesWhenItIsEndedBreaksTheLastRule) {
  const nlohmann::json report = conformance(python(
      "tests/processes/conformance/defective_target.py " SOURCE_DIR "/docs/examples/kit CrashWhenEnded"));
  EXPECT_EQ(broken(report).size(), 1U) << report.dump(1);
  EXPECT_THAT(report["rules"].back().dump(), HasSubstr("ended by SIGSEGV (Segmentation fault)"));
}

TEST(Conformance, BadInputIsOneLine) {
  expect_one_line(hil_bench("conformance --target /no/such/program"), "'/no/such/program': is not a program");
  expect_one_line(hil_bench("conformance --target /usr/bin/true"),
                  "exited with 0 before its first heartbeat");
  expect_one_line(hil_bench("conformance --estimator none_such"),
                  "--estimator 'none_such': has no flight, expected one of: ");
  expect_one_line(hil_bench("conformance --scenario none.toml"), "none.toml: cannot be read");
  expect_one_line(hil_bench("conformance --json /no/such/folder/x.json"), "/no/such/folder");
  expect_one_line(hil_bench(fmt::format("conformance --estimator wind --target {}", KIT_LOS_RATE)),
                  "accepts none of the estimators wind");
}

TEST(Conformance, HasTheReportsOfOtherCommands) {
  const std::string junit = scratch("conformance.xml");
  const Ended ended = hil_bench("conformance --estimator los_rate --junit " + junit);
  EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("PASS  P-CRC"));
  EXPECT_THAT(read(junit), HasSubstr("P-CRC"));
}

}  // namespace
}  // namespace canhil::test
