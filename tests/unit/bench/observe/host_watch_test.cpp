#include "bench/observe/host_watch.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <ctime>
#include <vector>

#include "bench/checks/evidence.hpp"
#include "bench/checks/judge.hpp"
#include "bench/observe/target_waits.hpp"
#include "bench/world/flight_record.hpp"

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
  const HostWatch watch(CLOCK_REALTIME, true);
  while (watch.record().cpu_run_s < 0.02) {
  }
  EXPECT_GT(watch.record().wall_s, 0);
  EXPECT_LE(watch.record().stolen_share, 1);
  EXPECT_TRUE(watch.record().may_be_realtime);
}

TEST(TargetWaits, TakeTheThreadThatWaitedLongest) {
  const std::vector<ThreadTimes> before{{1, 10 * ms, 1 * ms}, {2, 0, 0}};
  EXPECT_EQ(waited_for_others_ns(before, std::vector<ThreadTimes>{{1, 10 * ms, 4 * ms}, {2, 0, 1 * ms}}),
            3 * ms);
  EXPECT_EQ(waited_for_others_ns(before, std::vector<ThreadTimes>{{2, 0, 0}, {3, 0, 2 * ms}}), 2 * ms)
      << "a new thread waits from its start";
}

// While a thread waits, the target's other threads may hold the CPU: this is the target's own doing.
TEST(TargetWaits, DoNotCountAWaitForTheTargetsOwnThreads) {
  const std::vector<ThreadTimes> before{{1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(waited_for_others_ns(before, std::vector<ThreadTimes>{{1, 9 * ms, 0}, {2, 1 * ms, 8 * ms}}), 0);
  EXPECT_EQ(waited_for_others_ns(before, std::vector<ThreadTimes>{{1, 2 * ms, 0}, {2, 1 * ms, 8 * ms}}),
            6 * ms);
}

TEST(TargetWaits, SeeTheThreadsOfAProcess) {
  std::vector<ThreadTimes> times;
  read_thread_times(getpid(), times);
  ASSERT_FALSE(times.empty());
  EXPECT_EQ(times.front().thread, getpid());
  EXPECT_GT(times.front().run_ns, 0);
}

// A timing check of a run whose target waited.
class Waited : public testing::Test {
 protected:
  // `periods` of 100 periods with a wait of 3 ms.
  [[nodiscard]] checks::Finding judged(std::uint64_t periods, double quantile,
                                       checks::Outcome outcome) const {
    const checks::Observations seen;
    checks::Evidence evidence{.seen = seen, .truth = {.flight = flight_}};
    evidence.delays.waits.add(0, 100 - periods);
    if (periods > 0) evidence.delays.waits.add(3 * ms, periods);
    return checks::unless_target_delayed(
        evidence, quantile, 5e-3, {.outcome = outcome, .measured = "7 ms", .expected = {.text = "< 5 ms"}});
  }
  world::FlightRecord flight_{{.start = {}, .motion = world::Rest{}}, 0, 10'000};
};

TEST_F(Waited, AFailureIsTheHostsAtTheQuantileOfTheCheck) {
  EXPECT_EQ(judged(2, 0.99, checks::Outcome::fail).outcome, checks::Outcome::not_measured);
  EXPECT_EQ(judged(1, 0.99, checks::Outcome::fail).outcome, checks::Outcome::fail);
  EXPECT_EQ(judged(1, 1, checks::Outcome::fail).outcome, checks::Outcome::not_measured);
  EXPECT_EQ(judged(0, 1, checks::Outcome::fail).outcome, checks::Outcome::fail);
}

TEST_F(Waited, AStallOfTheCpusIsTheHostsToo) {
  const checks::Observations seen;
  checks::Evidence evidence{.seen = seen, .truth = {.flight = flight_}};
  evidence.delays.stalls.add(3 * ms);
  const checks::Finding failed{
      .outcome = checks::Outcome::fail, .measured = "7 ms", .expected = {.text = "< 5 ms"}};
  EXPECT_EQ(checks::unless_target_delayed(evidence, 1, 5e-3, failed).outcome, checks::Outcome::not_measured);
  EXPECT_EQ(checks::unless_target_delayed(evidence, 1, 7e-3, failed).outcome, checks::Outcome::fail);
}

TEST_F(Waited, WhatPassesAlthoughTheTargetWaitedPasses) {
  EXPECT_EQ(judged(100, 0.5, checks::Outcome::pass).outcome, checks::Outcome::pass);
}

// A check of a quantile of 1000 times, `outside` of which are beyond the limit of 5 ms. At 99 %, 10 may be.
class Disturbed : public Waited {
 protected:
  struct Host {
    std::uint64_t stimuli_off = 0, waits = 0, stalls = 0;  // of 1000 each
    std::int64_t by_ns = 3 * ms;
  };
  static void add(checks::Histogram& to, std::uint64_t times, std::int64_t ns) {
    to.add(0, 1000 - times);
    if (times > 0) to.add(ns, times);
  }
  [[nodiscard]] checks::Outcome judged(std::uint64_t outside, Host host, std::uint64_t missing = 0) const {
    const checks::Observations seen;
    checks::Evidence evidence{.seen = seen, .truth = {.flight = flight_}};
    add(evidence.delays.waits, host.waits, host.by_ns);
    add(evidence.delays.stalls, host.stalls, host.by_ns);
    checks::Histogram off;
    add(off, host.stimuli_off, host.by_ns);
    const checks::Times times{
        .nominal_s = 5e-3, .count = 1000, .missing = missing, .outside = outside, .bench_off = off};
    return checks::unless_host_disturbed(evidence, 0.99, 5e-3, times,
                                         {.outcome = checks::Outcome::fail, .measured = "", .expected = {}})
        .outcome;
  }
};

TEST_F(Disturbed, RareDisturbancesOfSeveralKindsExplainAFailureTogether) {
  EXPECT_EQ(judged(20, {.stimuli_off = 4, .waits = 2, .stalls = 1}), checks::Outcome::not_measured);
  EXPECT_EQ(judged(14, {.stalls = 2}), checks::Outcome::not_measured);
  EXPECT_EQ(judged(17, {.stalls = 1, .by_ns = 27 * ms}), checks::Outcome::not_measured);
  EXPECT_EQ(judged(16, {.waits = 2, .by_ns = 27 * ms}), checks::Outcome::not_measured)
      << "two of the three parts of the run in which the target waited";
}

TEST_F(Disturbed, ATargetThatIsLateMoreOftenFails) {
  EXPECT_EQ(judged(11, {}), checks::Outcome::fail);
  EXPECT_EQ(judged(21, {.stimuli_off = 4, .waits = 2, .stalls = 1}), checks::Outcome::fail);
  EXPECT_EQ(judged(15, {.stalls = 2}), checks::Outcome::fail);
  EXPECT_EQ(judged(18, {.stalls = 1, .by_ns = 27 * ms}), checks::Outcome::fail);
  EXPECT_EQ(judged(11, {.stimuli_off = 9, .waits = 9, .stalls = 9, .by_ns = 2 * ms}), checks::Outcome::fail)
      << "less than half of the limit";
}

TEST_F(Disturbed, TheHostDoesNotExplainAnswersThatNeverCame) {
  EXPECT_EQ(judged(4, {.waits = 1}, 8), checks::Outcome::not_measured);
  EXPECT_EQ(judged(5, {.waits = 1}, 8), checks::Outcome::fail);
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
  seen_.from_target.front().lost = 2;
  EXPECT_EQ(why(), "2 frames of the target were lost");
}

}  // namespace
}  // namespace canhil::observe
