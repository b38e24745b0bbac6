// Tests what the bench says of a target whose process ends otherwise than it should, and what is left of the
// processes of a run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <utility>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

// A target that is a shell script; $target is hil-target.
std::string script(const std::string& name, const std::string& text) {
  const std::string path = scratch(name);
  std::ofstream(path) << "#!/bin/sh\ntarget=" HIL_TARGET "\n" << text << '\n';
  EXPECT_EQ(shell("chmod +x " + path).code, 0);
  return path;
}
std::string defective(const std::string& defect) {
  return fmt::format(
      "'/usr/bin/python3 -B {0}/tests/processes/conformance/defective_target.py {0}/docs/examples/kit {1}'",
      SOURCE_DIR, defect);
}

Ended fly(const std::string& target, const std::string& more = "--lockstep") {
  return hil_bench(fmt::format("run {} --bus {} --target {} {}", scenario("transfer_alignment_quick"), bus(),
                               target, more));
}

// The flight lasts 6 s. The target crashes later than the shortest silence that ends a run.
TEST(TargetProcess, ThatCrashesAtTheEndOfAFlightFails) {
  const std::string report = scratch("crash.json");
  Ended ended;
  for (int chance = 1; chance <= 4; ++chance) {
    ended = hil_bench(fmt::format("run {} --bus {} --target {} --json {}", scenario("los_quick"), bus(),
                                  defective("CrashInFlight"), report));
    // On a busy host, the silence of the target may end the flight before that.
    if (ended.out.find("target silent since") == std::string::npos) break;
  }
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("\nfail: target: ended by SIGSEGV (Segmentation fault) at t="));
  EXPECT_GE(read_json(report)["ending"]["t_s"].get<double>(), 5.9);
}

// In this target, the shell that the bench started ends, and its child goes on and answers to the end.
constexpr auto headless = "$target \"$@\" </dev/null &\nsleep 1.5\nkill -SEGV $$";

TEST(TargetProcess, ThatEndsAlthoughItsChildAnswersOnFails) {
  const Ended ended = fly(script("headless", headless), "");
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(ended.out, ContainsRegex("\nfail: target: ended by SIGSEGV .* at t=[0-9]"));
}

// A program may take a second SIGTERM for impatience.
TEST(TargetProcess, IsToldToEndOnce) {
  const std::string path = script(
      "once",
      "trap 'ends=$((ends + 1)); sleep 0.3' TERM\n$target \"$@\" &\nwhile [ -z \"$ends\" ]; do wait; done\n"
      "exit $((ends - 1))");
  const Ended ended = fly(path);
  EXPECT_EQ(ended.code, 3) << ended.out;
  EXPECT_THAT(ended.out, testing::Not(HasSubstr("when the bench stopped it")));
}

TEST(TargetProcess, ThatExitsBeforeItIsStoppedFailsAlsoWith0) {
  const std::string quits = script("quits", "$target \"$@\" </dev/null &\nsleep 1.5\nexit 0");
  EXPECT_THAT(fly(quits, "").out, ContainsRegex("\nfail: target: exited with 0 at t=[0-9]"));
}

// A sanitizer reports a leak, or an error in a destructor, with an exit code of its own.
constexpr auto leaking = "trap 'exit 23' TERM\n$target \"$@\" </dev/null &\nwait";

TEST(TargetProcess, ThatEndsWithAnErrorWhenTheBenchStopsItFails) {
  const std::string report = scratch("leaking.json");
  const Ended ended = fly(script("leaking", leaking), "--lockstep --json " + report);
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("\nfail: target: exited with 23 when the bench stopped it, expected 0"));
  EXPECT_THAT(read_json(report)["checks"].dump(), HasSubstr("\"pass\"")) << "the flight itself was completed";
  const Ended crashed = hil_bench(fmt::format("run {} --bus {} --lockstep --target {}", scenario("los_quick"),
                                              bus(), defective("CrashWhenEnded")));
  EXPECT_THAT(crashed.out,
              HasSubstr("\nfail: target: ended by SIGSEGV (Segmentation fault) when the bench stopped it"));
}

TEST(TargetProcess, ThatEndsAsItShouldDoesNotFail) {
  for (const char* end : {"exit 0", "exit 143", "trap - TERM; kill -TERM $$"}) {
    const std::string fine = fmt::format("trap '{}' TERM\n$target \"$@\" </dev/null &\nwait", end);
    EXPECT_EQ(fly(script("fine", fine)).code, fly(HIL_TARGET).code) << end;
  }
}

TEST(TargetProcess, ThatDoesNotEndIsKilledAndNoted) {
  const std::string deaf = "trap '' TERM\n$target \"$@\" </dev/null &\nwait $!\nwhile :; do sleep 0.1; done";
  const Ended ended = fly(script("deaf", deaf));
  EXPECT_EQ(ended.code, fly(HIL_TARGET).code) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("the target did not end within 2 s after SIGTERM and was killed"));
}

// What holds for `run` holds for every command that starts a target.
TEST(TargetProcess, ThatEndsWithAnErrorFailsEveryCommand) {
  const std::string target = script("leaking", leaking), folder = scratch("golden");
  shell("rm -rf " + folder);
  const std::string flight = scenario("transfer_alignment_quick");
  ASSERT_EQ(hil_bench(fmt::format("golden record {} {}", folder, flight)).code, 0);
  const Ended golden = hil_bench(fmt::format("golden check {} --target {}", folder, target));
  EXPECT_EQ(golden.code, 1) << golden.err;
  EXPECT_THAT(golden.out, HasSubstr("exited with 23"));

  const Ended conformance =
      hil_bench(fmt::format("conformance --estimator transfer_alignment --target {}", target));
  EXPECT_EQ(conformance.code, 1) << conformance.err;
  EXPECT_THAT(conformance.out, HasSubstr("exited with 23"));

  const std::string set = scratch("no_effect.toml"), out = scratch("matrix");
  std::ofstream(set)
      << "[[fault]]\nkind = \"repeated\"\nfrom_s = 1\nto_s = 1.1\nmessages = [\"SlaveImuStatus\"]\n";
  const Ended faults =
      hil_bench(fmt::format("faults {} --set {} --out {} --threads 1 --target {}", flight, set, out, target));
  EXPECT_EQ(faults.code, 1) << faults.err;
  EXPECT_THAT(faults.out, HasSubstr("exited with 23"));

  const std::string campaign = scratch("campaign.toml"), results = scratch("results");
  shell("rm -rf " + results);
  std::ofstream(campaign) << fmt::format(
      "title = \"two\"\nruns = 2\nseed = 5\n[[variant]]\nname = \"one\"\nscenario = \"{}\"\n[[metric]]\n"
      "kind = \"divergence\"\nname = \"ends\"\nquantity = \"attitude.heading\"\nat_most = 0\n"
      "beyond_mrad = 1000\n",
      "flight.toml");
  std::ofstream(scratch("flight.toml")) << read(flight);
  const std::string run = fmt::format("campaign {} --threads 1 --out {}", campaign, results);
  const Ended whole = hil_bench(fmt::format("{}/fine --target {}", run, HIL_TARGET));
  EXPECT_EQ(whole.code, 0) << whole.err << whole.out;
  const Ended broken = hil_bench(fmt::format("{}/broken --target {}", run, target));
  EXPECT_EQ(broken.code, 1) << broken.err << broken.out;
}

// The bench starts the target in a process group of its own, and ends this group.
TEST(TargetProcess, LeavesNoChildBehind) {
  const std::string id = scratch("child");
  const std::string parent =
      fmt::format("sleep 1000 </dev/null >/dev/null 2>&1 &\necho $! >{}\n$target \"$@\"", id);
  EXPECT_EQ(fly(script("parent", parent)).code, fly(HIL_TARGET).code);
  EXPECT_NE(shell(fmt::format("kill -0 $(cat {})", id)).code, 0) << "the child is still there";
  // Also a child that ignores SIGTERM, and if the run did not begin.
  const std::string stubborn = fmt::format(
      "sh -c 'trap \"\" TERM; while :; do sleep 0.1; done' </dev/null >/dev/null 2>&1 &\necho $! >{}\nexit 3",
      id);
  EXPECT_EQ(fly(script("stubborn", stubborn)).code, 2);
  EXPECT_NE(shell(fmt::format("kill -0 $(cat {})", id)).code, 0) << "the child is still there";
}

}  // namespace
}  // namespace canhil::test
