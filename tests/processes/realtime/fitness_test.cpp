// Tests how timing checks react to a slow target and to an unfit host.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <pthread.h>
#include <sched.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <thread>
#include <vector>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::AnyOf;
using testing::ContainsRegex;
using testing::MatchesRegex;
using namespace std::chrono_literals;

int some_cpu() { return std::stoi(shell("taskset -cp $$ | sed 's/.*[ ,-]//'").out); }
bool may_have_priority(int priority) { return shell(fmt::format("chrt -f {} true", priority)).code == 0; }

// The path of a quick scenario whose latency check limits this quantile of the latency to 3 ms. If the
// quantile is the median, a few answers may be late, as happens on a shared machine.
std::string judged_by(const std::string& quantile) {
  std::string path = scratch(fmt::format("quantile_{}.toml", quantile));
  const Ended edited = shell(fmt::format(
      "sed '/kind = \"latency\"/,$ {{s/below_ms = .*/below_ms = 3/;s/quantile = .*/quantile = {}/}}' "
      "{} >{}",
      quantile, scenario("transfer_alignment_quick"), path));
  EXPECT_EQ(edited.code, 0) << edited.err;
  return path;
}

nlohmann::json check(const nlohmann::json& report, const std::string& kind) {
  for (const auto& one : report["checks"])
    if (one["kind"] == kind) return one;
  return {};
}

// On a shared machine the bench may be unable to judge the latency. Then the bench reports 'not measured',
// and the test repeats the run.
void expect_too_late(const std::string& slow, const char* where) {
  const std::string report = scratch("slow.json");
  const std::string priority = may_have_priority(40) ? "--realtime --priority 40" : "";
  for (int chance = 1; chance <= 5; ++chance) {
    const Ended ended = shell(fmt::format("{} {} run {} {} --target {} --json {}", slow, HIL_BENCH,
                                          judged_by("0.5"), priority, SLOW_TARGET, report));
    const nlohmann::json json = read_json(report);
    const nlohmann::json latency = check(json, "latency");
    if (latency["outcome"] == "not measured") {
      std::cerr << "chance " << chance << ": " << latency["measured"] << '\n';
      continue;
    }
    EXPECT_EQ(latency["outcome"], "fail");
    EXPECT_EQ(json["verdict"], "fail");
    EXPECT_EQ(ended.code, 1) << ended.err;
    EXPECT_THAT(ended.out, ContainsRegex("FAIL +latency AlignAttitude +[0-9.]+ ms of"));
    EXPECT_THAT(ended.out, ContainsRegex("fail: [0-9]+ of 9 checks failed"));
    EXPECT_GE(json["target_timing_us"][where], 4000);
    return;
  }
  FAIL() << "the bench was never fit to measure";
}

TEST(SlowTarget, ThatComputesForLongFailsTheCheckOfLatency) {
  expect_too_late("CANHIL_SLOW_COMPUTE_US=4000", "compute_max");
}

TEST(SlowTarget, ThatKeepsItsCpuBusyFailsTheCheckOfLatency) {
  expect_too_late("CANHIL_SLOW_BUSY_US=4000", "compute_max");
}

TEST(SlowTarget, ThatLetsFramesWaitFailsTheCheckOfLatency) {
  expect_too_late("CANHIL_SLOW_QUEUE_US=4000", "queue_max");
}

// Keeps a CPU busy for the time `busy` in each period.
class Hog {
 public:
  Hog(int cpu, int fifo_priority, std::chrono::microseconds busy, std::chrono::microseconds period)
      : thread_([=](const std::stop_token& stop) {
          cpu_set_t set;
          CPU_ZERO(&set);
          CPU_SET(cpu, &set);
          EXPECT_EQ(pthread_setaffinity_np(pthread_self(), sizeof set, &set), 0);
          const sched_param parameter{.sched_priority = fifo_priority};
          if (fifo_priority > 0) {
            EXPECT_EQ(pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter), 0);
          }
          while (!stop.stop_requested()) {
            const auto start = std::chrono::steady_clock::now();
            while (std::chrono::steady_clock::now() - start < busy) {
            }
            std::this_thread::sleep_until(start + period);
          }
        }) {}

 private:
  std::jthread thread_;
};

// If a CPU hog delays the bench, the bench reports one of these two reasons. The scheduler decides which one:
// the bench sleeps most of the time, so it can be late each time although it waits for a CPU during less than
// 5 % of the run. The host of a virtual machine can take CPU time too. If it does, the bench reports this
// first.
const std::string no_cpu =
    "(no CPU was free for the bench for|the hypervisor gave) [0-9.]+ % of (the run|this machine's .*)(; "
    "--realtime would help)?";
const std::string late =
    "this host kept the bench itself .* ms late \\(.*\\), more than 50 % of the limit(; --realtime would "
    "help)?";

// Expects that the timing checks with limits of a few ms are not measured, with the reason `no_cpu` or
// `late`, and that all other checks pass. The heartbeat check is not examined.
void expect_not_measured(const Ended& ended, const nlohmann::json& report) {
  EXPECT_EQ(report["verdict"], "not measured");
  EXPECT_EQ(ended.code, 3) << ended.out;
  int open = 0;
  for (const auto& one : report["checks"]) {
    if (one["kind"] == "heartbeat") continue;  // the limit of this check is half a second
    const bool timing = one["kind"] == "latency" || one["kind"] == "output_period";
    EXPECT_EQ(one["outcome"], timing ? "not measured" : "pass") << one;
    if (!timing) continue;
    EXPECT_THAT(one["measured"].get<std::string>(), AnyOf(MatchesRegex(no_cpu), MatchesRegex(late)));
    ++open;
  }
  EXPECT_EQ(open, 2);
}

TEST(CpuHog, BesideTheBenchLeavesTimingNotMeasured) {
  const int cpu = some_cpu();
  const std::string report = scratch("hogged.json");
  const std::vector<std::unique_ptr<Hog>> hogs = [&] {
    std::vector<std::unique_ptr<Hog>> all;
    for (int i = 0; i < 4; ++i) all.push_back(std::make_unique<Hog>(cpu, 0, 20ms, 20ms));
    return all;
  }();
  // The scheduler may let the bench go first each time that it wakes up. Then the hogs do not delay it, and a
  // pass is right.
  for (int chance = 1; chance <= 5; ++chance) {
    const Ended ended = shell(fmt::format("taskset -c {} {} run {} --json {}", cpu, HIL_BENCH,
                                          scenario("transfer_alignment_quick"), report));
    ASSERT_NE(ended.code, 1) << ended.out;
    if (ended.code != 0) return expect_not_measured(ended, read_json(report));
  }
  FAIL() << "the hogs never delayed the bench";
}

// The hogs run on the CPU of the target, the bench on another one. Whether the target waits depends on the
// host: of its own priority, a program that wakes up may go first. But the target never fails. With a hog of
// a higher priority it waits. If other programs delay the bench too, the bench reports this first, and the
// test repeats the run.
TEST(CpuHog, BesideTheTargetLeavesItsLatencyNotMeasured) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "needs two CPUs";
  const int cpu = some_cpu();
  const bool first = may_have_priority(41);
  const std::string report = scratch("hogged_target.json");
  const std::string waited =
      "[0-9.]+ ms of [0-9]+; on this host other programs kept the target waiting for a "
      "CPU for [0-9.]+ ms \\(99 % quantile\\), more than 50 % of the limit";
  std::string measured;
  for (int chance = 1; chance <= 5; ++chance) {
    std::vector<std::unique_ptr<Hog>> hogs;
    for (int i = 0; i < (first ? 1 : 4); ++i)
      hogs.push_back(first ? std::make_unique<Hog>(cpu, 41, 15ms, 30ms)
                           : std::make_unique<Hog>(cpu, 0, 20ms, 20ms));
    const Ended ended =
        hil_bench(fmt::format("run {} --target-cpu {} --json {}", judged_by("0.99"), cpu, report));
    const nlohmann::json latency = check(read_json(report), "latency");
    measured = latency["measured"].get<std::string>();
    ASSERT_NE(latency["outcome"], "fail") << measured;
    ASSERT_NE(ended.code, 1) << ended.out;
    if (!first || testing::Value(measured, MatchesRegex(waited))) return;
    std::cerr << "chance " << chance << ": " << measured << '\n';
  }
  std::cerr << "this host is too busy to show that the target waits: " << measured << '\n';
}

// The hog runs too rarely to take a noticeable share of CPU time. But each time it runs for longer than the
// 10 ms between two stimuli.
TEST(CpuHog, OfAHigherPriorityLeavesTheWorstLatencyNotMeasured) {
  if (!may_have_priority(41)) {
    std::cerr << "SCHED_FIFO 41 is not permitted here: only the hog of the bench's own priority is tried\n";
    EXPECT_EQ(hil_bench(fmt::format("run {} --realtime --priority 41", judged_by("1"))).code, 2);
    return;
  }
  const int cpu = some_cpu();
  const std::string report = scratch("fifo.json");
  const Hog hog(cpu, 41, 15ms, 600ms);
  const Ended ended = hil_bench(
      fmt::format("run {} --realtime --priority 40 --cpu {} --json {}", judged_by("1"), cpu, report));
  EXPECT_EQ(ended.code, 3) << ended.out;
  EXPECT_THAT(check(read_json(report), "latency")["measured"].get<std::string>(),
              AnyOf(MatchesRegex(late), MatchesRegex(no_cpu)));
}

}  // namespace
}  // namespace canhil::test
