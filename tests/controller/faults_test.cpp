// Tests faults of the wire, of a controller and of an interface. Each fault must be reported, the run must
// continue if possible, and no program may hang. wire/canhil_wire.c simulates the wire; to the driver, the
// kernel and the programs, the simulated wire looks like a real one.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "messages/canhil.hpp"
#include "tests/controller/guest.hpp"
#include "tests/vcan/interface.hpp"

namespace canhil::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct Outcome {
  Ended ended;
  nlohmann::json report;
  std::string target_said;
  [[nodiscard]] std::vector<std::string> incidents() const {
    std::vector<std::string> events;
    for (const auto& incident : report["bus"]["incidents"]) events.push_back(incident["event"]);
    return events;
  }
};

/// Runs the scenario `name` in real time, and calls `trouble` during the run.
Outcome run_with(const std::function<void()>& trouble, const std::string& name = "transfer_alignment_quick") {
  const std::string json = scratch("fault.json");
  Ended ended;
  const Target target;
  std::thread bench([&] { ended = bench_run(fmt::format("{} --json {}", scenario(name), json)); });
  await_syncs(50);
  trouble();
  bench.join();
  EXPECT_NE(ended.code, 2) << ended.err;
  EXPECT_NE(ended.code, 124) << "it hung";
  return {.ended = ended, .report = read_json(json), .target_said = target.said()};
}

TEST(Interface, DownAndUpAgainOnTheBenchsSideIsSurvivedAndReported) {
  set_up_on_wire();
  const Outcome outcome = run_with([] {
    set_interface("can1", false);
    ::usleep(200'000);
    set_interface("can1", true);
  });
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.ended.out;
  EXPECT_THAT(outcome.incidents(), testing::IsSupersetOf({"down", "up"}));
  EXPECT_EQ(outcome.report["bus"]["interface_down"], 1);
  EXPECT_EQ(outcome_of(outcome.report, "bus_errors"), "fail");
  EXPECT_EQ(outcome.ended.code, 1);
}

// A scenario can set an interface down and up again. It cannot inject error frames on these interfaces,
// because only the driver of the controller generates error frames.
TEST(Interface, IsSetDownAndUpByAFaultOfTheScenario) {
  set_up_on_wire();
  const auto with_fault = [](const std::string& kind) {
    std::string path = scratch(kind + ".toml");
    std::ofstream(path) << fmt::format("[[fault]]\nkind = \"{}\"\nfrom_s = 1\nfor_s = 0.2\n", kind);
    return path;
  };
  const std::string json = scratch("made.json");
  const Target target;
  const auto fly = [&](const std::string& kind) {
    return bench_run(fmt::format("{} --json {} --faults {}", scenario("transfer_alignment_quick"), json,
                                 with_fault(kind)));
  };
  const Ended ended = fly("interface_down");
  const Outcome outcome{.ended = ended, .report = read_json(json), .target_said = ""};
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << ended.out << ended.err;
  EXPECT_THAT(outcome.incidents(), testing::IsSupersetOf({"down", "up"}));
  EXPECT_EQ(outcome.report["faults"][0]["count"], 1);
  expect_one_line(fly("bus_off"), "'bus_off'");
}

TEST(Interface, DownForGoodOnTheBenchsSideEndsTheRun) {
  set_up_on_wire();
  const Outcome outcome = run_with([] { set_interface("can1", false); });
  EXPECT_FALSE(outcome.report["ending"]["completed"]);
  EXPECT_THAT(outcome.ended.out, HasSubstr("fail: the interface is down since t="));
  EXPECT_EQ(outcome.ended.code, 1);
}

TEST(Interface, DownAndUpAgainOnTheTargetsSideIsSurvivedAndReported) {
  set_up_on_wire();
  const Outcome outcome = run_with([] {
    set_interface("can0", false);
    ::usleep(100'000);
    set_interface("can0", true);
  });
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.ended.out;
  EXPECT_THAT(outcome.target_said,
              HasSubstr("hil-target: can0: the interface is down or removed; waiting for it"));
  EXPECT_THAT(outcome.target_said, HasSubstr("hil-target: can0: up again after "));
  EXPECT_THAT(outcome.incidents(), Contains("error passive"))
      << "nobody acknowledged the bench's frames meanwhile";
}

// Nobody acknowledges the frames of the bench's controller. Therefore the controller repeats the same frame
// endlessly, and the transmit queue becomes full.
TEST(Interface, DownForGoodOnTheTargetsSideEndsTheRun) {
  set_up_on_wire();
  const Outcome outcome = run_with([] { set_interface("can0", false); });
  EXPECT_FALSE(outcome.report["ending"]["completed"]);
  // The full queue rejects frames. The message states the time at which the first rejected frame was due.
  EXPECT_THAT(outcome.ended.out, testing::ContainsRegex("fail: .*the bus has accepted no frame since t="));
  EXPECT_THAT(outcome.incidents(), Contains("error passive"));
  EXPECT_EQ(outcome.ended.code, 1);
}

TEST(Interface, AdapterPulledAndPluggedInAgainOnTheBenchsSideIsSurvived) {
  set_up_on_wire();
  run("rmmod canhil_wire");  // the module of the simulated wire does not support the removal of a controller
  const Outcome outcome = run_with([] {
    run("echo 1 >/sys/class/net/can1/device/remove && echo 1 >/sys/bus/pci/rescan && "
        "ip link set can1 up type can bitrate 1000000");
  });
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.ended.out;
  EXPECT_EQ(outcome.report["bus"]["interface_down"], 1);
  EXPECT_EQ(outcome_of(outcome.report, "bus_errors"), "fail");
}

TEST(BusOff, OnTheBenchsSideWithRestartIsSurvivedAndReported) {
  set_up_on_wire("", "restart-ms 50");
  const Outcome outcome = run_with([] {
    wire("can1 broken");
    await_carrier("can1", false);
    wire("can1 sound");
  });
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.ended.out;
  EXPECT_THAT(outcome.incidents(), testing::IsSupersetOf({"error passive", "bus off", "restarted"}));
  EXPECT_GE(outcome.report["bus"]["bus_off"], 1);
  EXPECT_EQ(outcome.report["bus"]["bus_off"], outcome.report["bus"]["restarted"]);
  EXPECT_EQ(outcome_of(outcome.report, "bus_errors"), "fail");
  EXPECT_EQ(outcome.ended.code, 1);
  EXPECT_GE(outcome.report["target_counters"]["frames_lost"], 1)
      << "the frame that failed is lost, and counted";
}

// The bench is bus-off for longer than a target may be silent, and receives nothing in this time. The target
// receives no input in this time, and reports this as a fault. The run must end because of the reported
// fault, not because of the target's silence.
TEST(BusOff, OnTheBenchsSideForLongEndsWithTheTargetsFaultNotItsSilence) {
  set_up_on_wire("", "restart-ms 700");
  const Outcome outcome = run_with([] {
    wire("can1 broken");
    await_carrier("can1", false);
    wire("can1 sound");
  });
  EXPECT_EQ(outcome.report["bus"]["restarted"], 1);
  EXPECT_THAT(outcome.ended.out, HasSubstr("fail: the target reported a fault of its transfer_alignment"));
  EXPECT_EQ(outcome.ended.code, 1);
}

TEST(BusOff, OnTheBenchsSideWithoutRestartEndsTheRun) {
  set_up_on_wire();
  const Outcome outcome = run_with([] { wire("can1 broken"); }, "transfer_alignment");
  EXPECT_FALSE(outcome.report["ending"]["completed"]);
  EXPECT_THAT(outcome.ended.out, HasSubstr("fail: the bus is off since t="));
  EXPECT_EQ(outcome.ended.code, 1);
}

TEST(BusOff, OnTheTargetsSideWithRestartIsSurvivedAndReported) {
  set_up_on_wire("restart-ms 50", "");
  const Outcome outcome = run_with([] {
    wire("can0 broken");
    await_carrier("can0", false);
    wire("can0 sound");
  });
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.ended.out;
  EXPECT_THAT(outcome.target_said, HasSubstr("hil-target: can0: "));
  EXPECT_THAT(outcome.target_said, HasSubstr("bus off "));
  EXPECT_THAT(outcome.target_said, HasSubstr("restarted "));
}

TEST(BusErrors, AreDecodedAndCounted) {
  set_up_on_wire("", "berr-reporting on");
  const Outcome outcome = run_with([] {
    wire("can1 raise 40 0 0 b 0 0");    // arbitration lost in bit 11
    wire("can1 raise 80 0 8b 0 8 0");   // a stuff error
    wire("can1 raise 04 40 0 0 60 0");  // error warning, tx 96
    wire("can1 raise 04 0 0 0 0 0");    // error active
  });
  const auto& bus = outcome.report["bus"];
  EXPECT_TRUE(outcome.report["ending"]["completed"]) << outcome.ended.out;
  EXPECT_EQ(bus["lost_arbitration"], 1);
  EXPECT_EQ(bus["bus_error"], 1);
  EXPECT_EQ(bus["protocol"], 1);
  EXPECT_EQ(bus["error_warning"], 1);
  EXPECT_EQ(bus["tx_counter_max"], 96);
  EXPECT_EQ(bus["error_frames"], 4) << bus;
  EXPECT_EQ(outcome.report["target_counters"]["frames_lost"], 0);
}

void expect_clear_refusal(const Ended& ended) {
  EXPECT_EQ(ended.code, 2) << ended.out;
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("target on 'can1': no answer within 5 s while waiting for its heartbeat"));
  EXPECT_THAT(ended.err, HasSubstr("; can1 is error-passive, error counters tx 0 rx 128: "));
  EXPECT_THAT(ended.err, HasSubstr("with the same bit rate"));
  EXPECT_EQ(ended.out, "");
}

TEST(Bitrates, ThatDifferAreAConfigurationErrorNotAHang) {
  set_up_on_wire();
  set_up("bitrate 500000", "bitrate 1000000");
  const Target target;
  expect_clear_refusal(bench_run(scenario("transfer_alignment_quick")));
}

TEST(Bitrates, ThatDifferDoNotHoldUpTheNextRun) {
  set_up_on_wire();
  set_up("bitrate 500000 restart-ms 100", "bitrate 1000000 restart-ms 100");
  const Target target;
  expect_clear_refusal(bench_run(scenario("transfer_alignment_quick") + " --lockstep"));
  run("ip link set can1 down && ip link set can1 up type can bitrate 500000");
  const Ended ended = bench_run(scenario("transfer_alignment_quick") + " --lockstep");
  EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
  EXPECT_THAT(target.said(), HasSubstr("bus off ")) << "the target has been through it";
}

}  // namespace
}  // namespace canhil::test
