// Tests what SIGINT, SIGTERM and SIGHUP do to a command, and when the commands `before` and `after` of a
// scenario run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

// A flight that takes far longer than the time after which it is interrupted.
std::string long_flight() {
  const std::string path = scratch("long.toml");
  const std::string text = read(scenario("inflight_gps"));
  std::ofstream(path) << std::regex_replace(text, std::regex("duration_s = [0-9.]+"), "duration_s = 8000");
  return path;
}

// Runs a command and sends a signal to it after this time. The exit code is that of the command. A signal
// that comes while the command still reads its input ends it without a message, with a code from 128 on.
Ended interrupted(const std::string& signal, const std::string& arguments, double time_s) {
  return shell(fmt::format("timeout --preserve-status -s {} {} {} {}", signal, time_s, HIL_BENCH, arguments));
}
Ended interrupted(const std::string& signal, const std::string& arguments) {
  Ended ended;
  for (double time_s = 1; time_s < 100; time_s *= 2) {  // on a slow host, the signal must come later
    ended = interrupted(signal, arguments, time_s);
    if (ended.code < 128) break;
  }
  return ended;
}

// Sends the signal when the file, or the part of it that a program has written, has a first line.
Ended interrupted_after(const std::string& file, const std::string& signal, const std::string& arguments) {
  return shell(
      fmt::format("{} {} & bench=$!; while kill -0 $bench && ! find {}* -size +0 2>/dev/null | grep -q .; do "
                  "sleep 0.05; done; sleep 0.3; kill -s {} $bench; wait $bench",
                  HIL_BENCH, arguments, file, signal));
}

class Signal : public testing::TestWithParam<const char*> {};

TEST_P(Signal, EndsARunWhileTheTruthIsComputed) {
  const std::string report = scratch("interrupted.json");
  fs::remove(report);
  const Ended ended =
      interrupted(GetParam(), fmt::format("run {} --bus in-process --json {}", long_flight(), report));
  EXPECT_EQ(ended.code, 3) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("interrupted"));
  EXPECT_FALSE(fs::exists(report));
}

// The flight is short beside the computation of the truth, so the signal waits for the flight's log.
TEST_P(Signal, EndsARunDuringTheFlight) {
  const std::string report = scratch("interrupted.json"), log = scratch("interrupted.log");
  fs::remove(report);
  fs::remove(log);
  const Ended ended = interrupted_after(
      log, GetParam(), fmt::format("run {} --bus in-process --json {} --log {}", long_flight(), report, log));
  EXPECT_EQ(ended.code, 3) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("interrupted"));
  const nlohmann::json ending = read_json(report)["ending"];
  EXPECT_EQ(ending["completed"], false);
  EXPECT_EQ(ending["detail"], "interrupted");
}

INSTANTIATE_TEST_SUITE_P(Interruption, Signal, testing::Values("INT", "TERM", "HUP"));

TEST(Interruption, EndsARunOfACampaignWithoutItsResult) {
  const std::string campaign = scratch("long_campaign.toml"), results = scratch("long_results");
  shell("rm -rf " + results);
  static_cast<void>(long_flight());
  std::ofstream(campaign) << "title = \"long\"\nruns = 1\nseed = 5\n[[variant]]\nname = \"one\"\n"
                             "scenario = \"long.toml\"\n";
  for (const char* target : {"", "--target " HIL_TARGET}) {
    const Ended ended =
        interrupted("TERM", fmt::format("campaign {} --threads 1 --out {} {}", campaign, results, target));
    EXPECT_EQ(ended.code, 3) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("interrupted; --resume goes on with "));
    EXPECT_EQ(hil_bench(fmt::format("campaign report {}/long_campaign.sqlite", results)).code, 2)
        << "the interrupted run is no result";
    shell("rm -rf " + results);
  }
}

TEST(Interruption, EndsEveryOtherCommand) {
  const std::string flight = long_flight(), folder = scratch("long_golden"), out = scratch("long_matrix");
  shell(fmt::format("rm -rf {} {}", folder, out));
  EXPECT_EQ(interrupted("TERM", fmt::format("golden record {} {}", folder, flight)).code, 3);
  EXPECT_TRUE(fs::is_empty(folder));
  EXPECT_EQ(interrupted("TERM", fmt::format("faults {} --threads 1 --out {}", flight, out)).code, 3);
  EXPECT_EQ(interrupted("TERM", "accept --estimator wind").code, 3);
  // A target that does not send a heartbeat: `conformance` waits for it.
  EXPECT_EQ(interrupted("TERM", "conformance --target \"sh -c 'sleep 100'\"").code, 3);
  // A handshake that is interrupted.
  EXPECT_EQ(interrupted("TERM", fmt::format("run {} --target none --bus local:nobody", flight)).code, 3);
}

// A copy of the scenario with an ECU that has a DBC of its own, and with commands around the flight.
class Commands : public testing::Test {
 protected:
  const std::string folder_ = scratch("ecu"), was_ = folder_ + "/was";
  const std::string ecu_ = "--target '/usr/bin/python3 " SOURCE_DIR "/docs/examples/own_ecu/own_ecu.py'";

  std::string with(const std::string& before) {
    fs::remove_all(folder_);
    fs::copy(SOURCE_DIR "/docs/examples/own_ecu", folder_);
    const std::string commands = fmt::format(
        "before = \"echo before >>{0}; {1}\"\nafter = \"echo after >>{0}\"\nsettle_s", was_, before);
    const std::string text = read(folder_ + "/own_ecu.toml");
    const std::string path = folder_ + "/flight.toml";
    std::ofstream(path) << std::regex_replace(text, std::regex("settle_s"), commands);
    return path;
  }
};

TEST_F(Commands, AfterRunsWheneverBeforeRan) {
  const std::string once = "before\nafter\n";
  EXPECT_EQ(hil_bench(fmt::format("run {} --lockstep {}", with("true"), ecu_)).code,
            3);  // timing: not judged
  EXPECT_EQ(read(was_), once);
  EXPECT_EQ(hil_bench(fmt::format("run {} --target /usr/bin/false", with("true"))).code, 2);
  EXPECT_EQ(read(was_), once) << "if the target ends";
  EXPECT_EQ(hil_bench(fmt::format("run {} {}", with("false"), ecu_)).code, 2);
  EXPECT_EQ(read(was_), once) << "if before fails";
  EXPECT_EQ(interrupted_after(was_, "TERM", fmt::format("run {} {}", with("true"), ecu_)).code, 3);
  EXPECT_EQ(read(was_), once) << "if the run is interrupted";
}

TEST_F(Commands, AfterRunsAlsoInACampaign) {
  static_cast<void>(with("true"));
  std::ofstream(folder_ + "/campaign.toml")
      << "title = \"own ECU\"\nruns = 2\nseed = 5\n[[variant]]\nname = \"one\"\nscenario = \"flight.toml\"\n";
  const Ended ended =
      hil_bench(fmt::format("campaign {0}/campaign.toml --threads 1 --out {0} {1}", folder_, ecu_));
  EXPECT_EQ(ended.code, 3) << ended.err;  // without a metric nothing is judged
  EXPECT_EQ(read(was_), "before\nafter\nbefore\nafter\n");
}

TEST_F(Commands, BeforeIsInterruptedWithTheProcessesThatItStarted) {
  const std::string id = folder_ + "/id", through = folder_ + "/through";
  const std::string flight = with(fmt::format("sleep 20 & echo $! >{}; wait; touch {}", id, through));
  const Ended ended = interrupted_after(id, "TERM", fmt::format("run {} {}", flight, ecu_));
  EXPECT_EQ(ended.code, 3) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("interrupted while 'target.before' ran"));
  EXPECT_FALSE(fs::exists(through));
  EXPECT_NE(shell(fmt::format("kill -0 $(cat {})", id)).code, 0) << "the command's child is still there";
  EXPECT_EQ(read(was_), "before\nafter\n");
}

TEST_F(Commands, AreRefusedOnRequest) {
  const std::string flight = with("true"), campaign = folder_ + "/campaign.toml",
                    suites = folder_ + "/suites";
  std::ofstream(campaign) << "title = \"own ECU\"\nruns = 1\nseed = 5\n[[variant]]\nname = \"one\"\n"
                             "scenario = \"flight.toml\"\n";
  fs::create_directories(suites + "/own");
  std::ofstream(suites + "/own/suite.toml")
      << "title = \"own ECU\"\nestimator = \"several\"\n[[requirement]]\nid = \"SE-A1\"\nfamily = "
         "\"errors\"\ntext = \"It flies.\"\n[[campaign]]\nfile = \"../../campaign.toml\"\n";
  for (const std::string& command :
       {fmt::format("run {} --lockstep {}", flight, ecu_),
        fmt::format("campaign {} --threads 1 --out {} {}", campaign, folder_, ecu_),
        fmt::format("accept --suites {} --estimator several", suites)}) {
    expect_one_line(hil_bench(command + " --no-commands"), "key 'target.before': is a shell command ('");
    EXPECT_FALSE(fs::exists(was_)) << command;
  }
}

// For example a simulator that `before` starts and `after` ends.
TEST_F(Commands, WhatBeforeStartsInTheBackgroundRunsOn) {
  const std::string id = folder_ + "/id";
  const std::string flight = with(fmt::format("sleep 1000 >/dev/null 2>&1 & echo $! >{}", id));
  EXPECT_EQ(hil_bench(fmt::format("run {} --lockstep {}", flight, ecu_)).code, 3);
  EXPECT_EQ(shell(fmt::format("kill $(cat {})", id)).code, 0);
}

}  // namespace
}  // namespace canhil::test
