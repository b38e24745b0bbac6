// The tested property: the frames that the target sends depend only on the frames that the bench sends. This
// must be so on every bus, in lockstep, in real time, and in a replay.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

std::string record(const std::string& name, const std::string& options,
                   const std::string& file = "transfer_alignment_quick", Ended* how = nullptr) {
  std::string log = scratch(name);
  const Ended ended = hil_bench(fmt::format("run {} {} --log {}", scenario(file), options, log));
  EXPECT_NE(ended.code, 2) << ended.err;
  if (how != nullptr) *how = ended;
  return log;
}

// Records a run in real time. If the recording is incomplete, the run is repeated, because recordings can be
// compared only if they are complete.
std::string record_in_real_time(const std::string& name, const std::string& file = "transfer_alignment_quick",
                                Ended* how = nullptr) {
  const std::string report = scratch(name + ".json");
  EXPECT_EQ(fly_undisturbed([&] {
              const auto log = record(name, fmt::format("--bus {} --json {}", bus(), report), file, how);
              return RealTimeRun{.report = read_json(report), .log = log};
            }),
            "");
  return scratch(name);
}

TEST(Bits, InProcessLockstepAndRealTimeAgree) {
  const auto in_process = target_frames(record("in_process.log", "--bus in-process"));
  const auto lockstep = target_frames(record("lockstep.log", fmt::format("--bus {} --lockstep", bus())));
  const auto real_time = target_frames(record_in_real_time("real_time.log"));
  EXPECT_GT(in_process.size(), 500U);
  EXPECT_TRUE(in_process == lockstep);
  EXPECT_TRUE(in_process == real_time);
}

class BitsOfScenario : public testing::TestWithParam<const char*> {};

TEST_P(BitsOfScenario, InProcessAndLockstepAgree) {
  const std::string name = GetParam();
  const auto in_process = target_frames(record(name + ".in_process.log", "--bus in-process", name));
  const auto lockstep =
      target_frames(record(name + ".lockstep.log", fmt::format("--bus {} --lockstep", bus()), name));
  EXPECT_GT(in_process.size(), 3000U);
  EXPECT_TRUE(in_process == lockstep);
}

// In the scenario los_closed_loop, the answers of the target change the flight. The frames on two buses are
// equal only if each answer takes effect at the same time on both.
INSTANTIATE_TEST_SUITE_P(Bits, BitsOfScenario,
                         testing::Values("inflight_ssbl", "inflight_ssbl_180", "inflight_gps", "los_quick",
                                         "los_closed_loop", "los_closed_loop_500hz", "wind_quick",
                                         "all_four"),
                         [](const auto& test) { return test.param; });

class BitsOnAWire : public testing::TestWithParam<const char*> {};

// Simulated frame times must change neither the order of frames nor, in closed loop, the time at which an
// answer takes effect.
TEST_P(BitsOnAWire, AreThoseWithoutOne) {
  const std::string name = GetParam();
  const auto without = target_frames(record(name + ".no_wire.log", "--bus in-process", name));
  const auto with = target_frames(
      record(name + ".wire.log", "--bus 'in-process?bitrate=500000&bit-error-rate=1e-5'", name));
  EXPECT_GT(without.size(), 500U);
  EXPECT_TRUE(without == with);
}

INSTANTIATE_TEST_SUITE_P(Bits, BitsOnAWire,
                         testing::Values("transfer_alignment_quick", "inflight_quick", "los_closed_loop",
                                         "wind_quick"));

/// Tests the bits and the verdict together, because the flight in real time takes 30 s.
TEST(Bits, AnAlignmentInFlightPassesInRealTimeAndAgreesWithInProcess) {
  const std::string name = "inflight_quick";
  const auto in_process = target_frames(record("inflight.in_process.log", "--bus in-process", name));
  Ended ended;
  const auto real_time = target_frames(record_in_real_time("inflight.real_time.log", name, &ended));
  EXPECT_GT(in_process.size(), 1000U);
  EXPECT_TRUE(in_process == real_time);
  const auto report = read_json(scratch("inflight.real_time.log.json"));
  expect_outputs_passed(ended, report);
  EXPECT_EQ(figure(report, "inflight_alignment", "answers", "answers"), 1500);
  EXPECT_EQ(figure(report, "inflight_alignment", "answers", "accepted"), 29);
}

TEST(Bits, LosRateInProcessAndRealTimeAgree) {
  const auto in_process = target_frames(record("los.in_process.log", "--bus in-process", "los_quick"));
  const auto real_time = target_frames(record_in_real_time("los.real_time.log", "los_quick"));
  EXPECT_GT(in_process.size(), 3000U);
  EXPECT_TRUE(in_process == real_time);
}

TEST(Bits, AllFourAtOnceInProcessAndRealTimeAgree) {
  const auto in_process = target_frames(record("all_four.in_process.log", "--bus in-process", "all_four"));
  const auto real_time = target_frames(record_in_real_time("all_four.real_time.log", "all_four"));
  EXPECT_GT(in_process.size(), 30'000U);
  EXPECT_TRUE(in_process == real_time);
  // The checks pass in real time too. The heartbeat check is left out, because its outcome depends on the
  // host.
  const auto report = read_json(scratch("all_four.real_time.log.json"));
  for (const auto& check : report["checks"]) {
    if (check["kind"] == "heartbeat") continue;
    EXPECT_EQ(check["outcome"], "pass") << check.dump();
  }
}

TEST(Bits, AnotherSeedGivesOtherFrames) {
  EXPECT_FALSE(target_frames(record("seed1.log", "--bus in-process --seed 1")) ==
               target_frames(record("seed2.log", "--bus in-process --seed 2")));
}

TEST(Bits, AReplayedRunGivesTheSameFrames) {
  const std::string recorded = record("recorded.log", fmt::format("--bus {}", bus()));
  const std::string replayed = scratch("replayed.log");
  const Ended replay = shell(fmt::format("{} --replay {} > {}", HIL_TARGET, recorded, replayed));
  ASSERT_EQ(replay.code, 0) << replay.err;
  EXPECT_GT(target_frames(recorded).size(), 500U);
  EXPECT_TRUE(target_frames(recorded) == target_frames(replayed));
  EXPECT_EQ(hil_bench(fmt::format("diverge {} {}", recorded, replayed)).code, 0);
}

TEST(Bits, DivergeNamesTheFirstFrameThatDiffers) {
  const std::string log = record("original.log", "--bus in-process");
  EXPECT_EQ(hil_bench(fmt::format("diverge {} {}", log, log)).code, 0);

  // Flips one bit of the 100th AlignAttitude.
  ASSERT_EQ(
      shell(fmt::format(
                "awk '/ 0C0#/ && ++n == 100 {{ c = substr($3, length($3)); sub(/.$/, c == \"0\" ? \"1\" : "
                "\"0\", $3) }} {{ print }}' {} > {}",
                log, scratch("changed.log")))
          .code,
      0);
  const Ended differ = hil_bench(fmt::format("diverge {} {}", log, scratch("changed.log")));
  EXPECT_EQ(differ.code, 1);
  EXPECT_THAT(differ.out, testing::HasSubstr("differ at t=1.000 s"));
  EXPECT_THAT(differ.out, testing::ContainsRegex("AlignAttitude e2e_counter=[0-9]+ roll_deg="));

  ASSERT_EQ(shell(fmt::format("head -n 2000 {} > {}", log, scratch("short.log"))).code, 0);
  const Ended shorter = hil_bench(fmt::format("diverge {} {}", scratch("short.log"), log));
  EXPECT_EQ(shorter.code, 1);
  EXPECT_THAT(shorter.out, testing::HasSubstr("has no more frames of the target"));
  EXPECT_EQ(hil_bench(fmt::format("diverge {} no_such.log", log)).code, 2);

  std::ofstream(scratch("empty.log")).close();
  const auto expect_refused = [](const std::string& logs, const std::string& why) {
    const Ended refused = hil_bench("diverge " + logs);
    EXPECT_EQ(refused.code, 2) << logs;
    EXPECT_EQ(refused.err, "hil-bench: " + why + "\n");
    EXPECT_EQ(refused.out, "");
  };
  const std::string empty = scratch("empty.log"), folder = testing::TempDir();
  const std::string none = ": no frame of the target after a Sync, expected the log of a run";
  expect_refused(empty + " " + log, empty + none);
  expect_refused(log + " " + empty, empty + none);
  expect_refused(empty + " " + empty, empty + ", " + empty + none);
  expect_refused(log + " " + folder, "cannot read log '" + folder + "': Is a directory");
}

}  // namespace
}  // namespace canhil::test
