#include "bench/observe/host_watch.hpp"

#include <gtest/gtest.h>

#include <ctime>

#include "bench/checks/judge.hpp"

namespace canhil::observe {
namespace {

constexpr std::int64_t ms = 1'000'000;

TEST(ClockSteps, AnAdjustedClockDriftsAndDoesNotStep) {
  ClockSteps steps;
  for (std::int64_t t = 0; t < 10'000; ++t)
    steps.note(t * 10 * ms, 7 * ms + t * 10 * ms + t * 5'000);  // 500 ppm
  EXPECT_EQ(steps.largest_ns(), 0);
}

TEST(ClockSteps, ReadingsErrByLessThanAStep) {
  ClockSteps steps;
  for (std::int64_t t = 0; t < 100; ++t) steps.note(t * 10 * ms, t * 10 * ms + (t % 2) * 90'000);
  EXPECT_EQ(steps.largest_ns(), 0);
}

TEST(ClockSteps, FindsTheLargestEitherWay) {
  ClockSteps steps;
  steps.note(0, 0);
  steps.note(10 * ms, 10 * ms + 300'000);
  EXPECT_EQ(steps.largest_ns(), 300'000);
  steps.note(20 * ms, 18 * ms);
  EXPECT_EQ(steps.largest_ns(), -2 * ms - 300'000);
  steps.note(30 * ms, 28 * ms + 200'000);
  EXPECT_EQ(steps.largest_ns(), -2 * ms - 300'000) << "the largest stays";
}

TEST(CpuAccount, IsReadFromTheKernelsTexts) {
  const CpuAccount account =
      cpu_account("1500000 320000 42\n", "cpu  10 20 30 400 5 6 7 80 9 10\ncpu0 1 1 1 1 1 1 1 1 1 1\n");
  EXPECT_EQ(account.run_ns, 1'500'000);
  EXPECT_EQ(account.wait_ns, 320'000);
  EXPECT_EQ(account.stolen_ticks, 80U);
  EXPECT_EQ(account.all_ticks, 558U) << "guest time is in user and nice already";
}

TEST(CpuAccount, WhatAKernelDoesNotTellIsZero) {
  const CpuAccount account = cpu_account("", "");
  EXPECT_EQ(account.wait_ns, 0);
  EXPECT_EQ(account.stolen_ticks, 0U);
}

TEST(HostWatch, AccountsTheTimeOfThisProcess) {
  const HostWatch watch(CLOCK_REALTIME);
  while (watch.record().cpu_run_s < 0.02) {
  }
  EXPECT_GT(watch.record().wall_s, 0);
  EXPECT_LE(watch.record().stolen_share, 1);
}

class Unfit : public testing::Test {
 protected:
  Unfit() { seen_.host.wall_s = 10; }
  [[nodiscard]] std::string why() const { return checks::unfit_for_timing(seen_); }
  checks::Observations seen_;
};

TEST_F(Unfit, NothingHappened) { EXPECT_EQ(why(), ""); }

TEST_F(Unfit, AClockThatWasSet) {
  seen_.host.clock_step_ns = -2'500'000;
  EXPECT_EQ(why(), "the clock of the stamps was set by -2.500 ms in mid-run");
}

TEST_F(Unfit, ACpuWithoutRoom) {
  seen_.host.cpu_wait_s = 0.5;
  EXPECT_EQ(why(), "");
  seen_.host.cpu_wait_s = 0.52;
  EXPECT_EQ(why(), "no CPU was free for the bench for 5.2 % of the run");
}

TEST_F(Unfit, AMachineThatIsTakenAway) {
  seen_.host.stolen_share = 0.06;
  EXPECT_EQ(why(), "the hypervisor gave 6.0 % of this machine's CPU time to others");
}

TEST_F(Unfit, FramesThatWereLost) {
  seen_.receive_overflows = 3;
  EXPECT_EQ(why(), "the bench's port lost 3 frames");
  seen_.receive_overflows = 0;
  seen_.target_frames_lost = 2;
  EXPECT_EQ(why(), "2 frames of the target were lost");
}

}  // namespace
}  // namespace canhil::observe
