// Tests the option --realtime of both programs: its effects, and the error message if real-time priority is
// not permitted.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

// Runs a command without the rights that real-time priority and locked memory need (resource limits,
// capabilities).
Ended without_rights(const std::string& command) {
  return shell(fmt::format("prlimit --rtprio=0 --memlock=65536 {}{}",
                           without_capabilities("-sys_nice,-ipc_lock"), command));
}

std::string quick_run() { return fmt::format("run {} ", scenario("transfer_alignment_quick")); }

TEST(Realtime, IsRefusedWithTheRemedyByBothPrograms) {
  const std::string remedy =
      "rtprio 7' and '{} - memlock unlimited' to /etc/security/limits.d/canhil.conf and log in again, or "
      "`sudo setcap cap_sys_nice,cap_ipc_lock+ep {}`\n";
  std::string user = shell("id -un").out;
  user.pop_back();
  expect_one_line(without_rights(fmt::format("{} --bus local:nobody --realtime --priority 7", HIL_TARGET)),
                  fmt::format(fmt::runtime(remedy), user, HIL_TARGET));
  expect_one_line(without_rights(fmt::format("{} {} --realtime --priority 7", HIL_BENCH, quick_run())),
                  fmt::format(fmt::runtime(remedy), user, HIL_BENCH));
}

// The sanitizers replace mlockall() by a function that does nothing, because they use terabytes of shadow
// memory, which cannot be locked.
#ifdef CANHIL_SANITIZED
constexpr bool memory_is_locked = false;
#else
constexpr bool memory_is_locked = true;
#endif

// Whether --realtime is permitted here. The program chrt tests whether SCHED_FIFO is permitted; a user other
// than root must also be allowed to lock any amount of memory.
bool permitted() {
  return shell("chrt -f 40 true").code == 0 && (geteuid() == 0 || shell("ulimit -l").out == "unlimited\n");
}

TEST(Realtime, IsInForceInTheRunAndStatedInBothReports) {
  const std::string report = scratch("realtime.json");
  const std::string some_cpu = shell("taskset -cp $$ | sed 's/.*[ ,-]//'").out;
  const Ended ended = hil_bench(fmt::format("{} --realtime --priority 40 --cpu {} --spin-us 150 --json {}",
                                            quick_run(), std::stoi(some_cpu), report));
  if (!permitted()) return expect_one_line(ended, "--realtime: ");
  ASSERT_NE(ended.code, 2) << ended.err;
  const nlohmann::json process = read_json(report)["provenance"]["bench_process"];
  EXPECT_EQ(process["policy"], "SCHED_FIFO");
  EXPECT_EQ(process["priority"], 40);
  EXPECT_EQ(process["cpus"], nlohmann::json::array({std::stoi(some_cpu)}));
  EXPECT_GE(process["locked_kib"], memory_is_locked ? 64 * 1024 : 0);
  EXPECT_LE(process["timer_slack_ns"], 1);
  EXPECT_EQ(process["spin_us"], 150);
  EXPECT_THAT(shell("uname -v").out + "none or voluntary",
              HasSubstr(process["preemption"].get<std::string>()));
  EXPECT_THAT(ended.out, HasSubstr(fmt::format("bench SCHED_FIFO 40, CPU {},", std::stoi(some_cpu))));
  EXPECT_TRUE(read_json(report)["ending"]["completed"]) << read_json(report)["ending"];
}

TEST(Realtime, IsNotInForceUnlessAskedFor) {
  const std::string report = scratch("ordinary.json");
  ASSERT_NE(hil_bench(fmt::format("{} --json {}", quick_run(), report)).code, 2);
  const nlohmann::json process = read_json(report)["provenance"]["bench_process"];
  EXPECT_EQ(process["policy"], "SCHED_OTHER");
  EXPECT_EQ(process["locked_kib"], 0);
}

// Starts a run. Prints the scheduling and the locked memory of the target in the middle of the run, and the
// number of page faults of the bench in the following 1.5 s.
std::string started_target(const std::string& options) {
  const Ended seen = shell(
      fmt::format("faults() {{ cut -d' ' -f10 /proc/$1/stat; }}; "
                  "{} {} {} >{} 2>&1 & "
                  "for i in $(seq 100); do read pid rest </proc/$!/task/$!/children; [ \"$pid\" ] && break; "
                  "sleep 0.1; done; "
                  "sleep 1; before=$(faults $!); "
                  "chrt -p $pid; grep -E '^(VmLck|Cpus_allowed_list)' /proc/self/status /proc/$pid/status; "
                  "sleep 1.5; echo bench: $(($(faults $!) - before)) faults; wait $!",
                  HIL_BENCH, quick_run(), options, scratch("started.out")));
  return seen.out + seen.err + read(scratch("started.out"));
}

TEST(Realtime, TheStartedTargetTakesItTooOnTheCpusThatTheBenchHadOrOnOneOfItsOwn) {
  if (!permitted()) return expect_one_line(hil_bench(quick_run() + "--realtime"), "--realtime: ");
  const int last_cpu = std::stoi(shell("taskset -cp $$ | sed 's/.*[ ,-]//'").out);
  const std::string all_cpus = shell("grep Cpus_allowed_list /proc/self/status").out;
  const std::string beside = started_target(fmt::format("--realtime --cpu {}", last_cpu));
  EXPECT_THAT(beside, HasSubstr("SCHED_FIFO"));
  EXPECT_THAT(beside, HasSubstr("priority: 40\n"));
  EXPECT_THAT(beside, ContainsRegex("/proc/[0-9]+/status:" + all_cpus));
  EXPECT_THAT(beside, ContainsRegex(memory_is_locked ? "/proc/[0-9]+/status:VmLck:[\t ]*[1-9]" : "VmLck"));
  EXPECT_THAT(beside, ContainsRegex(memory_is_locked ? "bench: [0-9] faults" : "bench: [0-9]+ faults"))
      << "in mid-run, each at the cost of a late frame";
  const std::string pinned = started_target(fmt::format("--target-cpu {}", last_cpu));
  EXPECT_THAT(pinned, HasSubstr("SCHED_OTHER"));
  EXPECT_THAT(pinned, ContainsRegex(fmt::format("/proc/[0-9]+/status:Cpus_allowed_list:\t{}\n", last_cpu)));
}

TEST(Realtime, WhatCannotBeIsRefused) {
  expect_one_line(hil_target("--bus local:nobody --cpu 0"), "--cpu requires --realtime");
  expect_one_line(hil_target("--replay x.log --realtime"), "excludes");
  expect_one_line(hil_bench(quick_run() + "--realtime --lockstep"), "excludes");
  expect_one_line(hil_bench(quick_run() + "--spin-us 5 --bus in-process"), "virtual time has no deadlines");
  expect_one_line(hil_bench(quick_run() + "--spin-us 10001"),
                  "--spin-us: '10001' is not a whole number from 0");
  expect_one_line(hil_bench(quick_run() + "--target-cpu 1023"),
                  "--target-cpu 1023: this process may not run");
  expect_one_line(hil_bench(quick_run() + "--target-cpu 0 --target none"), "no target is started here");
  if (permitted())
    expect_one_line(hil_bench(quick_run() + "--realtime --cpu 1023"), "--cpu 1023: this process");
}

}  // namespace
}  // namespace canhil::test
