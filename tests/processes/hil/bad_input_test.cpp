// Bad input: one line (what, where, what was expected), exit code 2, nothing half written.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "dbc/ports/local_bus.hpp"
#include "dbc/wire/transmit.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

void expect_one_line(const Ended& ended, const std::string& what) {
  EXPECT_EQ(ended.code, 2) << ended.out << ended.err;
  EXPECT_THAT(ended.err, HasSubstr(what));
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_EQ(ended.out, "");
}

TEST(BadInput, UnknownBus) {
  expect_one_line(hil_bench(fmt::format("run {} --bus nocan7", scenario("transfer_alignment_quick"))),
                  "nocan7");
  expect_one_line(hil_target("--bus nocan7"), "nocan7");
}

TEST(BadInput, NobodyHostsTheBus) {
  expect_one_line(hil_target("--bus local:nobody-here"), "nobody hosts it");
}

TEST(BadInput, MissingScenario) { expect_one_line(hil_bench("run no_such.toml"), "no_such.toml"); }

TEST(BadInput, UnknownScenarioKey) {
  std::ofstream(scratch("typo.toml"))
      << read(scenario("transfer_alignment_quick")) << "\n[slave_inu]\nperiod_ms = 10\n";
  expect_one_line(hil_bench("run " + scratch("typo.toml")), "slave_inu");
}

TEST(BadInput, ParameterOutOfRangeIsRefusedByTheTarget) {
  std::string text = read(scenario("transfer_alignment_quick"));
  const std::string section = "[target.parameters]\n";
  ASSERT_NE(text.find(section), std::string::npos);
  text.insert(text.find(section) + section.size(), "h2_case = 7\n");
  std::ofstream(scratch("range.toml")) << text;
  expect_one_line(hil_bench(fmt::format("run {} --bus {}", scratch("range.toml"), bus())),
                  "parameter 'h2_case' = 7: refused by the target: out_of_range");
}

std::string edited(const std::string& file, std::string_view from, std::string_view to) {
  std::string text = read(scenario("transfer_alignment_quick"));
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, from.size(), to);
  std::ofstream(scratch(file)) << text;
  return scratch(file);
}

TEST(BadInput, ValueThatTheBusCannotCarry) {
  expect_one_line(hil_bench("run " + edited("fine.toml", "heading_deg = 5.0", "heading_deg = 0.001")),
                  "initial value 0.001 deg does not fit into TargetInitSigma.heading_sigma_deg");
  expect_one_line(hil_bench("run " + edited("fast.toml", "speed_kmph = 500.0", "speed_kmph = 9000.0")),
                  "TargetInitVelocityNE.velocity_north_mps, expected -1677 to 1677");
  expect_one_line(hil_bench("run " + edited("slow.toml", "[slave_imu]", "[slave_imu]\nperiod_ms = 50")),
                  "IMU interval 50000 us does not fit into SlaveImuStatus.interval_us");
}

TEST(BadInput, UnknownOption) {
  expect_one_line(hil_bench("run --colour x.toml"), "--colour");
  expect_one_line(hil_target("--bus x --speed 3"), "--speed");
  expect_one_line(hil_target(""), "--bus");
}

TEST(BadInput, ReportThatCannotBeWrittenIsToldBeforeTheRun) {
  expect_one_line(
      hil_bench(fmt::format("run {} --json /no/such/folder/x.json", scenario("transfer_alignment_quick"))),
      "/no/such/folder/x.json");
}

TEST(BadInput, FilesThatWouldReplaceSomethingElse) {
  const std::string quick = scenario("transfer_alignment_quick");
  ASSERT_EQ(shell("mkfifo " + scratch("pipe")).code, 0);
  expect_one_line(hil_bench(fmt::format("run {} --junit {}", quick, scratch("pipe"))), "is no regular file");
  ASSERT_EQ(shell(fmt::format("cp {} {}", quick, scratch("self.toml"))).code, 0);
  expect_one_line(hil_bench(fmt::format("run {0} --log {0}", scratch("self.toml"))), "is named twice");
  EXPECT_EQ(read(scratch("self.toml")), read(quick));
}

// Both are refused without disturbing the run that is under way.
TEST(BadInput, ASecondBenchOrTargetOnABus) {
  const std::string quick = scenario("transfer_alignment_quick");
  const std::string report = scratch("first.json");
  const Ended second =
      shell(fmt::format("{0} run {1} --bus local:shared --json {2} >{3} & first=$!; sleep 1.5; {4} --bus "
                        "local:shared; echo $? >{5}; "
                        "{0} run {1} --bus local:shared --target none; code=$?; wait $first; exit $code",
                        HIL_BENCH, quick, report, scratch("first.out"), HIL_TARGET, scratch("target.code")));
  EXPECT_EQ(second.code, 2) << second.out << second.err;
  EXPECT_EQ(read(scratch("target.code")), "2\n");
  EXPECT_THAT(second.err, HasSubstr("a target answers here already"));
  EXPECT_THAT(second.err, HasSubstr("another bench is at work here"));
  EXPECT_TRUE(read_json(report)["ending"]["completed"]);
  EXPECT_EQ(read_json(report)["from_target"]["frames_lost"], 0);
}

TEST(BadInput, LogThatIsNoLog) {
  std::ofstream(scratch("broken.log")) << "(1.000000) can0 0A0#00\nnonsense\n";
  expect_one_line(hil_target("--replay " + scratch("broken.log")), "broken.log:2:");
}

TEST(BadInput, AnUnfinishedRunLeavesNoLog) {
  const std::string log = scratch("unfinished.log");
  const Ended ended = hil_bench(fmt::format("run {} --bus {} --target /bin/false --log {}",
                                            scenario("transfer_alignment_quick"), bus(), log));
  EXPECT_EQ(ended.code, 2);
  EXPECT_FALSE(std::filesystem::exists(log));
  EXPECT_FALSE(std::filesystem::exists(log + ".part"));
}

// A target of another DBC: the test hosts the bus and beats with another hash.
TEST(BadInput, TargetBuiltFromAnotherDbc) {
  const std::string bus = "local:other-dbc";
  auto hub = host_local_bus(bus, {});
  ASSERT_TRUE(hub) << hub.error().message;
  std::atomic<bool> stop = false;
  std::thread other_target([&] {
    Outbox<1> out;
    while (!stop) {
      out.clear();
      out.send(messages::TargetHeartbeat{.dbc_hash = messages::dbc_hash24 ^ 0xFFU});
      static_cast<void>((*hub)->send(out.frames().front()));
      for (int i = 0; i < 10; ++i) {
        while ((*hub)->receive()) {
        }
        wait(**hub, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + 5'000'000);
      }
    }
  });
  const Ended ended =
      hil_bench(fmt::format("run {} --bus {} --target none", scenario("transfer_alignment_quick"), bus));
  stop = true;
  other_target.join();
  expect_one_line(ended, "target and bench are built from different DBC files");
}

}  // namespace
}  // namespace canhil::test
