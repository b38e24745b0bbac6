// Targets that leave evidence out: answers, counts, signs of trouble or their own state. Missing evidence
// never makes a check pass.
#include <gmock/gmock.h>

#include "tests/processes/hil/liar.hpp"

namespace canhil::test {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* counts = "\n[[check]]\nkind = \"counts_match\"\n";
constexpr const char* values = R"(
[[check]]
kind = "answers"
name = "never degraded"
degraded_at_most = 0
to_s = 5.0
[[check]]
kind = "honest"
[[check]]
kind = "sigma"
quantity = "los.rate.pitch"
between_mradps = [0.0, 1e6]
from_s = 4.9
to_s = 5.4
)";

std::string target(const std::string& lie) { return "--target " + liar(lie); }

TEST(Evidence, CountersThatStopOrGoDownFail) {
  const std::string file = with("los_quick", counts);
  const auto of = [&](const std::string& lie) { return fly(file, target(lie)).report; };
  const auto honest = of("none");
  EXPECT_THAT(failed(honest), IsEmpty());
  for (const char* kind : {"counters", "counts_match"}) {
    EXPECT_EQ(of_check(honest, kind, "outcome"), "pass");
    EXPECT_THAT(measured(of("counters_stop"), kind), HasSubstr("TargetCounters stopped at 0.9 s")) << kind;
    EXPECT_THAT(measured(of("counts_fall"), kind), HasSubstr("went down: frames lost 77 -> 0 at 1 s"))
        << kind;
    EXPECT_EQ(of_check(of("counters_stop"), kind, "outcome"), "fail");
  }
}

TEST(Evidence, WhatTheHeartbeatSaysIsJudged) {
  const auto said = [](const std::string& lie) {
    const Flown flown = fly(scenario("los_quick"), target(lie));
    EXPECT_EQ(flown.ended.code, 1) << lie;
    EXPECT_THAT(failed(flown.report), ElementsAre("target_state")) << lie;
    EXPECT_THAT(flown.ended.out, HasSubstr("target's heartbeat"));
    return measured(flown.report, "target_state");
  };
  EXPECT_THAT(said("idle_in_flight"), ContainsRegex("^los_rate idle from [0-9.]+ s$"));
  EXPECT_THAT(said("numeric_error"), ContainsRegex("^error los_rate numeric from [0-9.]+ s$"));
  EXPECT_THAT(said("another_version"), ContainsRegex("los_rate version_minor .* from [0-9.]+ s"));
  const auto honest = fly(scenario("los_quick"), target("none")).report;
  EXPECT_THAT(failed(honest), IsEmpty())
      << "at the end of the flight no samples come: this explains input_lost";
}

TEST(Evidence, ATargetThatRebootsFails) {
  const Flown flown = fly(scenario("los_quick"), target("reboots"), "--realtime");
  EXPECT_EQ(flown.ended.code, 1);
  EXPECT_TRUE(of_check(flown.report, "target_state", "outcome") == "fail" ||
              flown.report["ending"]["completed"] == false)
      << flown.ended.out;
}

TEST(Evidence, ErrorsAfterAFaultThatStruckAreExplained) {
  const auto lost_at = [](const std::string& from_s) {
    return with("los_quick", fmt::format("\n[[fault]]\nname = \"f\"\nkind = \"lost\"\nmessages = "
                                         "[\"SeekerRange\"]\nfrom_s = {}\nfor_s = 0.02\n",
                                         from_s));
  };
  EXPECT_THAT(failed(fly(lost_at("0.5"), target("numeric_error")).report),
              Not(testing::Contains("target_state")));
  EXPECT_THAT(failed(fly(lost_at("3"), target("numeric_error")).report), testing::Contains("target_state"));
}

TEST(Evidence, MissingAnswersFailEveryCheckOfValues) {
  const std::string file = with("los_quick", values);
  const auto honest = fly(file, target("none")).report;
  EXPECT_THAT(failed(honest), IsEmpty());
  EXPECT_EQ(honest["answers"]["LosRateTarget"]["due"], honest["answers"]["LosRateTarget"]["came"]);
  for (const char* lie :
       {"one_answer_in_150", "silent_from_600", "silent_before_900", "one_answer_missing"}) {
    const auto report = fly(file, target(lie)).report;
    for (const auto& check : report["checks"]) {
      if (check["name"] == "never degraded" || check["kind"] == "honest") {
        EXPECT_EQ(check["outcome"], "fail") << lie << ": " << check.dump();
      }
    }
  }
  EXPECT_THAT(failed(fly(file, target("one_answer_in_150")).report),
              testing::IsSupersetOf({"error", "answers", "honest", "sigma"}));
}

TEST(Evidence, MissingAnswersCountInQuantilesOfTimes) {
  for (const char* lie : {"one_answer_in_150", "silent_before_900"}) {
    const auto report = fly(scenario("los_quick"), target(lie), "--realtime").report;
    for (const char* kind : {"latency", "output_period"})
      EXPECT_NE(of_check(report, kind, "outcome"), "pass") << lie << ", " << kind;
  }
}

TEST(Evidence, CompareNoticesFewerAnswers) {
  const auto report_of = [](const std::string& lie) {
    std::string file = scratch(lie + ".json");
    hil_bench(fmt::format("run {} --bus {} --lockstep --json {} {}", with("los_quick", ""), bus(), file,
                          target(lie)));
    return file;
  };
  const std::string all = report_of("none"), few = report_of("one_answer_in_150");
  EXPECT_THAT(hil_bench("compare " + all + " " + few).out,
              ContainsRegex("worse +answers of LosRateTarget: 0 of"));
  EXPECT_THAT(hil_bench("compare " + few + " " + all).out, Not(HasSubstr("answers of LosRateTarget")));
}

std::string response(const std::string& fault, const std::string& check) {
  return with("los_quick",
              fmt::format("\n[[fault]]\nname = \"f\"\n{}\n[[check]]\nfault = \"f\"\n{}\n", fault, check));
}
constexpr const char* after_the_flight = "kind = \"lost\"\nnode = \"seeker\"\nfrom_s = 5.7\nto_s = 5.8";
constexpr const char* bias = "kind = \"bias\"\nquantity = \"seeker.range\"\nby_m = 500\nfrom_s = 2\nto_s = 3";
constexpr const char* tolerated =
    "kind = \"noise\"\nquantity = \"seeker.range\"\nsigma_m = 0.001\nfrom_s = 2\nto_s = 3";

TEST(Evidence, AFaultThatDidNotStrikeShowsNothing) {
  for (const char* check :
       {"kind = \"detected_within\"\nwithin_s = 0.2", "kind = \"recovers_within\"\nwithin_s = 0.1",
        "kind = \"sigma_grows\"\nquantity = \"los.rate.pitch\""}) {
    const auto report = fly(response(after_the_flight, check), "").report;
    const std::string kind = report["checks"].back()["kind"];
    EXPECT_EQ(of_check(report, kind, "outcome"), "not measured") << check;
    EXPECT_EQ(measured(report, kind), "the fault 'f' did not strike");
  }
}

TEST(Evidence, ASignThatWasThereBeforeShowsNothing) {
  const std::string detected = "kind = \"detected_within\"\nwithin_s = 0.3\nby = [\"degraded\"]";
  const auto report = fly(response(bias, detected), target("always_degraded")).report;
  EXPECT_EQ(of_check(report, "detected_within", "outcome"), "not measured");
  EXPECT_EQ(measured(report, "detected_within"), "already present before it: degraded in an answer");
  const auto honest =
      fly(with("los_quick", "\n[[check]]\nkind = \"honest\"\n"), target("always_degraded")).report;
  EXPECT_EQ(of_check(honest, "honest", "outcome"), "not measured") << "nothing is trusted";
}

TEST(Evidence, WithoutASignThereIsNothingToRecoverFrom) {
  const auto report =
      fly(response(tolerated, "kind = \"recovers_within\"\nwithin_s = 0.5\nby = [\"numeric\"]"), "").report;
  EXPECT_EQ(of_check(report, "recovers_within", "outcome"), "not measured");
  EXPECT_THAT(measured(report, "recovers_within"), HasSubstr("nothing to recover from"));
}

TEST(Evidence, AnAlwaysDegradedTargetToleratesNothing) {
  const std::string set = scratch("tolerated.toml"), out = scratch("matrix");
  std::ofstream(set) << "[[fault]]\nname = \"f\"\n" << tolerated << "\n";
  const auto matrix = [&](const std::string& lie) {
    shell("rm -rf " + out);
    return hil_bench(
        fmt::format("faults {} --set {} --out {} {}", scenario("los_quick"), set, out, target(lie)));
  };
  EXPECT_THAT(matrix("none").out, HasSubstr("tolerated"));
  const Ended degraded = matrix("always_degraded");
  EXPECT_THAT(degraded.out, Not(HasSubstr("tolerated")));
  EXPECT_THAT(degraded.out, HasSubstr("not measured"));
  EXPECT_EQ(degraded.code, 3);
}

TEST(Evidence, ACampaignAgainstAProgramFailsWhereARunFails) {
  const std::string file = scratch("one.toml");
  std::ofstream(file) << fmt::format(R"(title = "One"
runs = 1
seed = 5
[[variant]]
name = "A"
scenario = "{}"
[[metric]]
kind = "divergence"
quantity = "los.rate.pitch"
beyond_mradps = 1e9
at_most = 1
)",
                                     scenario("los_quick"));
  const auto fly_campaign = [&](const std::string& lie) {
    const std::string out = scratch(lie + ".sqlite");
    shell("rm -f " + out);
    return hil_bench(fmt::format("campaign {} --out {} {}", file, out, target(lie)));
  };
  const Ended honest = fly_campaign("none");
  EXPECT_EQ(honest.code, 0) << honest.out << honest.err;
  for (const auto& [lie, code, why] :
       {std::tuple{"cause_time_off", 1, "causes: LosRate: .* answers with no cause"},
        std::tuple{"cause_counter_off_by_one", 1, "causes: LosRate: .* counter of another cause"},
        std::tuple{"answers_twice", 3, "answers given twice: LosRate"},
        std::tuple{"idle_in_flight", 1, "target_state: los_rate idle"}}) {
    EXPECT_EQ(fly(scenario("los_quick"), target(lie)).ended.code, code) << lie;
    const Ended ended = fly_campaign(lie);
    EXPECT_EQ(ended.code, code) << lie << ended.out << ended.err;
    EXPECT_THAT(ended.out, ContainsRegex(why));
    const Ended again = hil_bench("campaign report " + scratch(std::string(lie) + ".sqlite"));
    EXPECT_EQ(again.code, code) << lie;
    EXPECT_THAT(again.out, ContainsRegex(why)) << "the store keeps the reason";
  }
}

}  // namespace
}  // namespace canhil::test
