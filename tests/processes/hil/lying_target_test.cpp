// Targets that are correct except for one fault: the bench reports the fault, and the run does not pass.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "dbc/logs/log.hpp"
#include "messages/canhil.hpp"
#include "tests/processes/hil/liar.hpp"

namespace canhil::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;

/// A quick flight in which samples are lost, repeated and damaged. An additional check compares the target's
/// counts of such samples with the number of faults.
std::string lossy() {
  return with("transfer_alignment_quick", R"(
[[fault]]
kind = "lost"
messages = ["SlaveImuDeltaV"]
from_s = 0.5
to_s = 1.0
every = 20
[[fault]]
kind = "damaged"
messages = ["SlaveImuStatus"]
from_s = 1.0
to_s = 1.5
every = 20
[[fault]]
kind = "repeated"
messages = ["MasterInsVelocityNE"]
from_s = 0.5
to_s = 1.5
every = 3
[[check]]
kind = "counts_match"
)");
}

using Kinds = std::vector<std::string>;

TEST(Lies, TheCountsOfAnHonestTargetMatchWhatTheBenchDid) {
  const Flown flown = fly(lossy(), "");
  EXPECT_EQ(measured(flown.report, "counts_match"), "frames lost 6, bad CRC 3, bad groups 6, late 4");
  EXPECT_THAT(failed(flown.report), testing::Not(testing::Contains("counts_match")));
}

TEST(Lies, CountsThatAreNotThoseOfTheBenchFailWhereErrorsPass) {
  const Kinds honest = failed(fly(lossy(), "").report);
  for (const char* lie : {"forgets_losses", "counts_one_loss_more"}) {
    const Flown flown = fly(lossy(), "--target " + liar(lie));
    EXPECT_EQ(flown.ended.code, 1) << lie;
    Kinds expected = honest;
    expected.emplace_back("counts_match");
    std::erase(expected, lie == std::string("forgets_losses") ? "counters" : "");
    EXPECT_EQ(failed(flown.report), expected) << lie;
  }
}

TEST(Lies, InRealTimeTheCountsMatchTooAndALieIsFound) {
  const std::string report = scratch("real_time.json");
  const std::string run = fmt::format("run {} --bus {} --json {}", lossy(), bus(), report);
  Kinds honest;
  for (int attempt = 0; attempt < 4; ++attempt) {  // if the host stalls for long, the target loses frames
    ASSERT_NE(hil_bench(run).code, 2);
    honest = failed(read_json(report));
    if (std::ranges::find(honest, "counts_match") == honest.end()) break;
  }
  EXPECT_THAT(honest, testing::Not(testing::Contains("counts_match")));
  EXPECT_EQ(hil_bench(run + " --target " + liar("forgets_losses")).code, 1);
  EXPECT_THAT(failed(read_json(report)), testing::Contains("counts_match"));
}

TEST(Lies, AnswersWithTheCounterOfAnotherCauseFailTheRun) {
  for (const char* flight : {"transfer_alignment_quick", "inflight_quick", "los_quick", "wind_quick"}) {
    EXPECT_THAT(failed(fly(scenario(flight), "").report), IsEmpty()) << flight;
    const Flown flown = fly(scenario(flight), "--target " + liar("cause_counter_off_by_one"));
    EXPECT_EQ(flown.ended.code, 1) << flight;
    EXPECT_EQ(failed(flown.report), Kinds{"causes"}) << flight;
    EXPECT_THAT(flown.ended.out, ContainsRegex("FAIL +causes .* answers with the counter of another cause"))
        << flight;
  }
}

TEST(Lies, AnswersWithTheTimeOfNoCauseFailTheRun) {
  const Flown flown = fly(scenario("los_quick"), "--target " + liar("cause_time_off"));
  EXPECT_EQ(flown.ended.code, 1);
  EXPECT_THAT(failed(flown.report), testing::Contains("causes"));
  EXPECT_THAT(measured(flown.report, "causes"),
              ContainsRegex("^LosRate: [1-9][0-9]+ answers with no cause, nearest 5 us off$"));
}

/// The outcome and the figures of each check of values.
std::vector<std::string> judged(const nlohmann::json& report) {
  std::vector<std::string> all;
  for (const auto& check : report["checks"])
    all.push_back(fmt::format("{} {}: {}, {}", check["kind"].get<std::string>(),
                              check["name"].get<std::string>(), check["outcome"].get<std::string>(),
                              check["measured"].get<std::string>()));
  return all;
}

/// A table without the NEES, which compare an update with the first navigation answer that arrives after it.
std::string without_nees(const std::string& csv) {
  std::istringstream lines(read(csv));
  std::string rest;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("nees,") == std::string::npos) rest += line + '\n';
  }
  return rest;
}

TEST(Lies, AnswersOutOfOrderAreComparedWithTheTruthOfTheirCauses) {
  for (const auto& [flight, lie] :
       {std::pair("los_quick", "late_answers"), std::pair("wind_quick", "late_winds"),
        std::pair("transfer_alignment_quick", "late_navigation"),
        std::pair("inflight_quick", "late_fixes")}) {
    const std::string in_order = scratch("in_order.csv"), late = scratch("late.csv");
    const Flown honest = fly(scenario(flight), "--csv " + in_order);
    const Flown flown = fly(scenario(flight), fmt::format("--target {} --csv {}", liar(lie), late));
    EXPECT_EQ(judged(flown.report), judged(honest.report)) << flight;
    EXPECT_TRUE(without_nees(late) == without_nees(in_order)) << flight;
  }
}

TEST(Lies, GarbageThatComesLateFailsTheRun) {
  const Flown flown = fly(scenario("los_quick"), "--target " + liar("late_garbage"));
  EXPECT_EQ(flown.ended.code, 1);
  EXPECT_THAT(failed(flown.report), testing::Contains("error"));
  EXPECT_THAT(measured(flown.report, "error"), ContainsRegex("^RMS [0-9]{4}\\."))
      << "half of them are off by 3 rad/s";
}

TEST(Lies, OfAGroupThatIsNeverWholeTheMessageToBlameIsNamed) {
  const auto blamed = [](const std::string& lie) {
    const Flown flown = fly(scenario("los_quick"), "--target " + liar(lie));
    EXPECT_EQ(flown.ended.code, 1) << lie;
    return measured(flown.report, "answer_groups");
  };
  EXPECT_THAT(blamed("no_sigma"),
              ContainsRegex("^LosRate: [0-9]+ frames and no whole group: LosRateSigma missing$"));
  EXPECT_THAT(blamed("sigma_with_wrong_crc"), ContainsRegex("group: LosRateSigma: [0-9]+ with a wrong CRC$"));
  EXPECT_THAT(blamed("sigma_with_another_counter"), HasSubstr("its messages never have one counter"));
}

// The answers themselves are right, and none is missing.
TEST(Lies, CountersThatStandStillOrJumpFailTheRun) {
  const Flown still = fly(scenario("los_quick"), "--target " + liar("counter_stands_still"));
  EXPECT_EQ(still.ended.code, 1) << still.ended.out;
  EXPECT_THAT(measured(still.report, "protection"),
              ContainsRegex("^TargetCounters: [1-9][0-9]* of [0-9]+ frames repeat the counter"));
  const Flown jumps = fly(scenario("los_quick"), "--target " + liar("counters_jump"));
  EXPECT_EQ(jumps.ended.code, 1) << jumps.ended.out;
  EXPECT_EQ(failed(jumps.report), Kinds{"protection"}) << jumps.ended.out;
  EXPECT_THAT(measured(jumps.report, "protection"),
              ContainsRegex("LosRateSigma: the counter jumps over [1-9][0-9]+ frames that are not missing"));
}

// A check of the scenario judges the messages that it names.
TEST(Lies, AScenarioMayLimitTheErrorsOfProtection) {
  const std::string file =
      with("los_quick", "[[check]]\nkind = \"protection\"\nmessage = \"LosRateSigma\"\n");
  EXPECT_THAT(measured(fly(file, "").report, "protection"),
              HasSubstr("wrong checksums 0, wrong counters 0, wrong sizes 0, lost by the counter 0"));
  for (const char* lie : {"sigma_with_wrong_crc", "counters_jump"}) {
    const Flown flown = fly(file, "--target " + liar(lie));
    EXPECT_EQ(flown.ended.code, 1) << lie;
    EXPECT_THAT(failed(flown.report), testing::Contains("protection")) << lie;
  }
}

TEST(Lies, AHandshakeThatFailsSaysWhatItSaw) {
  const auto seen = [](const std::string& lie) {
    const Ended ended =
        hil_bench(fmt::format("run {} --bus {} --target {}", scenario("los_quick"), bus(), liar(lie)));
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_EQ(ended.code, 2) << lie;
    return ended.err;
  };
  const std::string nothing = "no answer within 5 s while waiting for its heartbeat; seen: ";
  EXPECT_THAT(seen("heartbeat_with_wrong_crc"),
              ContainsRegex(nothing + "TargetHeartbeat: [1-9][0-9]* with a wrong CRC"));
  EXPECT_THAT(seen("heartbeat_with_counter_15"),
              ContainsRegex(nothing + "TargetHeartbeat: [1-9][0-9]* with counter 15, which is not allowed"));
  EXPECT_THAT(seen("short_heartbeat"),
              ContainsRegex(nothing + "TargetHeartbeat: [1-9][0-9]* of 7 bytes, expected 8"));
  EXPECT_THAT(seen("other_ids"), AllOf(HasSubstr("frames of other ids: 0x456"), HasSubstr("no heartbeat")));
  EXPECT_THAT(seen("acknowledges_another_parameter"),
              HasSubstr("ParamAck for another parameter: closed_loop"));
  EXPECT_THAT(
      seen("never_ready"),
      ContainsRegex("answers, but never says ready within 2 s while taking its initial state: state idle, "
                    "estimator los_rate, .*errors: none"));
}

TEST(Lies, AHandshakeThatFailsLeavesItsLog) {
  const std::string log = scratch("handshake.log");
  const auto fail = [&] {
    return hil_bench(fmt::format("run {} --bus {} --log {} --target {}", scenario("los_quick"), bus(), log,
                                 liar("heartbeat_with_wrong_crc")))
        .err;
  };
  EXPECT_THAT(fail(), HasSubstr("; the log of the handshake is '" + log + "'\n"));
  auto reader = LogReader::open(log);
  ASSERT_TRUE(reader) << reader.error().message;
  const auto entry = reader->next();
  ASSERT_TRUE(entry && *entry);
  EXPECT_EQ((*entry)->frame.id, messages::TargetHeartbeat::info.id);
  const std::string first = read(log);
  EXPECT_THAT(fail(), HasSubstr("; the log of the handshake is '" + log + ".incomplete'\n"));
  EXPECT_EQ(read(log), first) << "a run that does not begin takes nothing away";
}

}  // namespace
}  // namespace canhil::test
