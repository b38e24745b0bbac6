// Faults of the bus during a run, and what a user sees of them: the verdict, the reports, the messages of the
// target. Two things cause faults on vcan0: error frames that a program sends, and changes of the interface.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <thread>

#include "messages/canhil.hpp"
#include "tests/processes/hil/program.hpp"
#include "tests/vcan/interface.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string make_vcan0 =
    "ip link add dev vcan0 type vcan && ip link set vcan0 mtu 72 && ip link set vcan0 up";

struct Outcome {
  Ended ended;
  nlohmann::json report;
  [[nodiscard]] std::string outcome_of(const std::string& kind) const {
    for (const auto& check : report["checks"]) {
      if (check["kind"] == kind) return check["outcome"];
    }
    return "no such check";
  }
  [[nodiscard]] std::vector<std::string> incidents() const {
    std::vector<std::string> events;
    for (const auto& incident : report["bus"]["incidents"]) events.push_back(incident["event"]);
    return events;
  }
};

/// Flies over vcan0 in real time. During the run, executes the shell command `trouble`, which causes the
/// fault.
Outcome run_with(const std::string& trouble, const std::string& more_checks = "") {
  std::ofstream(scratch("outage.toml")) << read(scenario("transfer_alignment_quick")) << more_checks;
  const std::string json = scratch("outage.json");
  Ended ended;
  std::thread bench(
      [&] { ended = hil_bench(fmt::format("run {} --bus vcan0 --json {}", scratch("outage.toml"), json)); });
  {
    const auto listener = open("vcan0", {.only_ids = {messages::Sync::info.id}});
    for (int syncs = 0; syncs < 50; ++syncs) EXPECT_TRUE(next_frame(*listener));
  }
  run(trouble);
  bench.join();
  EXPECT_NE(ended.code, 2) << ended.err;
  return {.ended = ended, .report = read_json(json)};
}

TEST(Outages, ABusOffWithRestartIsSurvivedReportedAndFailsTheRun) {
  const Outcome outcome = run_with(
      "cansend vcan0 20000204#0020000000008000 && cansend vcan0 20000040#0000000000000000 && "
      "cansend vcan0 20000100#0000000000000000");
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.report["ending"];
  EXPECT_THAT(outcome.incidents(), testing::ElementsAre("error passive", "bus off", "restarted"));
  const auto& bus = outcome.report["bus"];
  EXPECT_EQ(bus["error_frames"], 3);
  EXPECT_EQ(bus["bus_off"], 1);
  EXPECT_EQ(bus["restarted"], 1);
  EXPECT_EQ(bus["tx_counter_max"], 128);
  EXPECT_GT(bus["incidents"][1]["t_s"].get<double>(), 0.4);
  EXPECT_EQ(outcome.outcome_of("bus_errors"), "fail") << "no check of the scenario speaks of the bus";
  EXPECT_EQ(outcome.ended.code, 1);
  EXPECT_THAT(outcome.ended.out, HasSubstr("FAIL          bus_errors"));
  EXPECT_THAT(outcome.ended.out, HasSubstr("3 error frames (bus off 1, restarted 1, error passive 1; "
                                           "error counters at most tx 128, rx 0)"));
  EXPECT_THAT(outcome.ended.out, HasSubstr("s  bus off (tx 128, rx 0)"));
  EXPECT_THAT(outcome.ended.err, HasSubstr("hil-target: vcan0: 3 error frames (bus off 1, restarted 1"));
}

TEST(Outages, AScenarioMayAllowABusOff) {
  const Outcome outcome =
      run_with("cansend vcan0 20000040#0000000000000000 && cansend vcan0 20000100#0000000000000000",
               "\n[[check]]\nkind = \"bus_errors\"\nbus_off_at_most = 1\n");
  EXPECT_EQ(outcome.outcome_of("bus_errors"), "pass");
}

TEST(Outages, AnInterfaceDownAndUpAgainIsSurvivedAndFailsTheRun) {
  const Outcome outcome = run_with("ip link set vcan0 down && ip link set vcan0 up");
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.report["ending"];
  EXPECT_THAT(outcome.incidents(), testing::ElementsAre("down", "up"));
  EXPECT_EQ(outcome.report["bus"]["interface_down"], 1);
  EXPECT_EQ(outcome.report["target_counters"]["frames_lost"], 0) << "what was due meanwhile was sent after";
  EXPECT_EQ(outcome.outcome_of("bus_errors"), "fail");
  EXPECT_THAT(outcome.ended.err, HasSubstr("hil-target: vcan0: up again after "));
}

TEST(Outages, AnInterfaceMadeAnewIsSurvived) {
  const auto anew = [] {
    return run_with("ip link del vcan0 && " + make_vcan0,
                    "\n[[check]]\nkind = \"bus_errors\"\ndown_at_most = 1\n");
  };
  Outcome outcome = anew();
  // On a loaded host, the interface may be away for longer than a target waits for samples (0.5 s).
  const auto away_too_long = [&] {
    return outcome.report["ending"]["detail"].get<std::string>().find("input_silent") != std::string::npos;
  };
  for (int left = 3; left > 0 && away_too_long(); --left) outcome = anew();
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.report["ending"];
  EXPECT_EQ(outcome.report["bus"]["interface_down"], 1);
  EXPECT_EQ(outcome.outcome_of("bus_errors"), "pass");
}

TEST(Outages, AnInterfaceThatStaysAwayEndsTheRunAndIsNamed) {
  const Outcome outcome = run_with("ip link del vcan0");
  run(make_vcan0);
  EXPECT_FALSE(outcome.report["ending"]["completed"]);
  EXPECT_THAT(outcome.ended.out, HasSubstr("fail: the interface is down since t="));
  EXPECT_THAT(outcome.ended.err, HasSubstr("hil-target: vcan0: the interface is down or removed"));
  EXPECT_EQ(outcome.ended.code, 1);
}

TEST(Outages, TheBenchMakesThemByItselfWhereAScenarioSaysSo) {
  const std::string json = scratch("made.json"), faults = scratch("faults.toml");
  std::ofstream(faults) << "[[fault]]\nkind = \"error_frame\"\nperiod_ms = 50\nfrom_s = 0.5\nto_s = 0.7\n"
                           "[[fault]]\nkind = \"error_passive\"\nfrom_s = 1\nfor_s = 0.1\n"
                           "[[fault]]\nkind = \"bus_off\"\nfrom_s = 1.5\nfor_s = 0.1\n"
                           "[[fault]]\nkind = \"interface_down\"\nfrom_s = 2\nfor_s = 0.2\n"
                           "[[fault]]\nkind = \"wrong_crc\"\nnode = \"slave_imu\"\nevery = 50\n"
                           "[[fault]]\nkind = \"flood\"\nperiod_us = 1000\nfrom_s = 2.5\n";
  const Ended ended = hil_bench(fmt::format("run {} --bus vcan0 --faults {} --json {}",
                                            scenario("transfer_alignment_quick"), faults, json));
  ASSERT_NE(ended.code, 2) << ended.err;
  Outcome outcome{.ended = ended, .report = read_json(json)};
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.report["ending"];
  EXPECT_THAT(outcome.incidents(),
              testing::ElementsAre("error passive", "error active", "bus off", "restarted", "down", "up"));
  EXPECT_EQ(outcome.report["bus"]["error_frames"], 5 + 2 + 2);
  EXPECT_GT(outcome.report["target_counters"]["bad_crc"], 0);
  for (const auto& fault : outcome.report["faults"]) EXPECT_GT(fault["count"], 0) << fault["name"];
  EXPECT_THAT(ended.err, HasSubstr("hil-target: vcan0: 9 error frames (bus off 1, restarted 1"));
}

/// A shell command that slows vcan0 down for half a second: frames wait in a queue of some bytes, and the bit
/// rate is enough for only a third of them.
std::string slow_wire(int queue_bytes) {
  return fmt::format(
      "tc qdisc add dev vcan0 root tbf rate 20kbit burst 100 limit {} && sleep 0.5 && "
      "tc qdisc del dev vcan0 root",
      queue_bytes);
}

class FullQueue : public testing::TestWithParam<int> {};

TEST_P(FullQueue, KeepsFramesWaitingAndLosesNone) {
  const Outcome outcome = run_with(slow_wire(GetParam()));
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.report["ending"];
  EXPECT_GT(outcome.report["bus"]["late_in_queue"], 0);
  EXPECT_EQ(outcome.report["target_counters"]["frames_lost"], 0) << "the bench drops nothing";
  EXPECT_THAT(outcome.ended.out, HasSubstr(fmt::format("late in transmit queue {} frames",
                                                       outcome.report["bus"]["late_in_queue"].get<int>())));
}

INSTANTIATE_TEST_SUITE_P(OfTheSocket, FullQueue, testing::Values(100'000));
INSTANTIATE_TEST_SUITE_P(OfTheInterface, FullQueue, testing::Values(40));

TEST(Outages, AQuietBusHasNothingToTell) {
  const Outcome outcome = run_with("true");
  EXPECT_EQ(outcome.report["bus"]["error_frames"], 0);
  EXPECT_THAT(outcome.incidents(), testing::IsEmpty());
  EXPECT_EQ(outcome.outcome_of("bus_errors"), "no such check");
  EXPECT_THAT(outcome.ended.out,
              HasSubstr("bus                           0 error frames; interface down 0 times; "
                        "late in transmit queue 0 frames"));
  EXPECT_EQ(outcome.ended.err, "");
}

}  // namespace
}  // namespace canhil::test
