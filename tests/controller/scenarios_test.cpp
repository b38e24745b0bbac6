// Runs the four estimators over the emulated controllers and the kernel's driver. Their outputs must pass the
// checks, and must be equal, bit for bit, to their outputs in a run in process.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/controller/guest.hpp"

namespace canhil::test {
namespace {

// The run in process takes place in the guest too. On the host, some bits of its frames could be different,
// because the host's processor may compute a sine with other instructions.
std::vector<Frame> frames_in_process(const std::string& name) {
  const std::string log = scratch("in_process.log");
  EXPECT_EQ(hil_bench(fmt::format("run {} --bus in-process --log {}", scenario(name), log)).code, 3);
  return target_frames(log);
}

void expect_pass_in_lockstep(const std::string& name) {
  const std::string report = scratch("report.json"), log = scratch("lockstep.log");
  const Target target;
  const Ended ended = bench_run(fmt::format("{} --lockstep --json {} --log {}", scenario(name), report, log));
  ASSERT_EQ(ended.code, 3) << "3: outputs pass, timing is not measured in lockstep\n"
                           << ended.out << ended.err;
  expect_outputs_passed(ended, read_json(report));
  const auto frames = target_frames(log);
  EXPECT_GT(frames.size(), 1000U);
  EXPECT_TRUE(frames == frames_in_process(name)) << "not the bits of a run in process";
}

class Lockstep : public testing::TestWithParam<const char*> {};

TEST_P(Lockstep, PassesAt1Mbps) {
  set_up("bitrate 1000000", "bitrate 1000000");
  expect_pass_in_lockstep(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Quick, Lockstep,
                         testing::Values("transfer_alignment_quick", "inflight_quick", "los_quick",
                                         "wind_quick"));

TEST(LockstepAlso, TransferAlignmentPassesAt500kbps) {
  set_up("bitrate 500000", "bitrate 500000");
  expect_pass_in_lockstep("transfer_alignment_quick");
}

// The emulated clock can disturb the timing, but not the outputs. If the host suspends the guest, the bench
// and the target may lose frames or wait for too long. Such a run is repeated.
TEST(RealTime, TransferAlignmentPasses) {
  set_up("bitrate 1000000", "bitrate 1000000");
  const std::string name = "transfer_alignment_quick", report = scratch("report.json"),
                    log = scratch("real.log");
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Target target;
    const Ended ended = bench_run(fmt::format("{} --json {} --log {}", scenario(name), report, log));
    ASSERT_NE(ended.code, 2) << ended.err;
    const auto json = read_json(report);
    if (attempt < 2 && (!json["ending"]["completed"] || json["target_counters"]["frames_lost"] != 0 ||
                        json["from_target"]["frames_lost"] != 0))
      continue;
    expect_outputs_passed(ended, json);
    EXPECT_TRUE(target_frames(log) == frames_in_process(name)) << "not the bits of a run in process";
    return;
  }
}

}  // namespace
}  // namespace canhil::test
