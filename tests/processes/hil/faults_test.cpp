// Tests faults of the four stages (sensor, node, bus, target) in runs of two processes over the embedded bus,
// and what the report shows about these faults.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

const std::string counts_match = "[[check]]\nkind = \"counts_match\"\n";

struct Flown {
  Ended ended;
  nlohmann::json report;
  [[nodiscard]] std::string outcome_of(const std::string& kind) const {
    for (const auto& check : report["checks"]) {
      if (check["kind"] == kind)
        return check["outcome"].get<std::string>() + ": " + check["measured"].get<std::string>();
    }
    return "no such check";
  }
};

std::string faults_file(const std::string& faults) {
  std::string path = scratch("faults.toml");
  std::ofstream(path) << faults;
  return path;
}

/// Flies a quick flight with an additional check counts_match, and with faults from a separate file.
Flown fly(const std::string& faults, const std::string& how = "--lockstep") {
  const std::string flight = scratch("flight.toml"), json = scratch("report.json");
  std::ofstream(flight) << read(scenario("transfer_alignment_quick")) << counts_match;
  std::string command = fmt::format("run {} --bus {} {} --json {}", flight, bus(), how, json);
  if (!faults.empty()) command += " --faults " + faults_file(faults);
  Flown flown{.ended = hil_bench(command), .report = {}};
  EXPECT_NE(flown.ended.code, 2) << flown.ended.err << faults;
  if (flown.ended.code != 2) flown.report = read_json(json);
  return flown;
}

std::string fault(const std::string& kind, const std::string& keys) {
  return fmt::format("[[fault]]\nkind = \"{}\"\n{}\n", kind, keys);
}

/// The target's report contains counters of losses. Returns the names of those that are not 0, for example
/// "bad_crc late".
std::string causes(const Flown& flown) {
  std::string causes;
  for (const auto& [cause, count] : flown.report["target_counters"].items()) {
    if (count != 0) causes += (causes.empty() ? "" : " ") + cause;
  }
  return causes;
}

TEST(Faults, OfTheBusAreCountedByTheirCauseExactly) {
  const std::string theta = "messages = [\"SlaveImuDeltaTheta\"]\nfrom_s = 1\nto_s = 2\n";
  struct Case {
    std::string kind, keys, causes;
  };
  for (const Case& one : std::vector<Case>{
           {"lost", theta + "for_s = 0.03\neach_s = 0.2", "bad_group frames_lost"},
           {"lost", "node = \"slave_imu\"\nfrom_s = 1\nto_s = 2\npercent = 10", "bad_group frames_lost"},
           {"damaged", theta + "bits = 3\nevery = 10", "bad_crc bad_group frames_lost"},
           {"wrong_crc", theta + "every = 10", "bad_crc bad_group frames_lost"},
           {"counter_stuck", theta + "for_s = 0.03\neach_s = 0.3", "bad_group frames_lost late"},
           {"counter_jump", theta + "every = 10\nby = 3", "bad_group frames_lost"},
           {"delayed", theta + "every = 10\nby_ms = 12", "bad_group frames_lost"},
           {"reordered", theta + "every = 10", "bad_group frames_lost"},
           {"repeated", theta + "every = 10", "late"},
           {"too_short", theta + "every = 10", "bad_crc bad_group frames_lost"},
           {"foreign", theta + "every = 10", "bad_group frames_lost"},
           {"stranger", "period_ms = 3\nfrom_s = 1\nto_s = 2", ""},
           {"flood", "period_us = 1000\nfrom_s = 1\nto_s = 2", ""},
           {"silent", "node = \"slave_imu\"\nfrom_s = 1\nto_s = 1.05", ""},
           {"restart", "node = \"slave_imu\"\nfrom_s = 1.01\nsilent_s = 0.05", "frames_lost"},
       }) {
    const Flown flown = fly(fault(one.kind, one.keys));
    EXPECT_THAT(flown.outcome_of("counts_match"), testing::StartsWith("pass")) << one.kind;
    EXPECT_EQ(causes(flown), one.causes) << one.kind << ": " << flown.outcome_of("counts_match");
    EXPECT_GT(flown.report["faults"][0]["count"], 0) << one.kind;
    EXPECT_TRUE(flown.report["ending"]["completed"]) << one.kind;
  }
}

TEST(Faults, OfLengthAreCountedOnCanFd) {
  const Flown flown =
      fly(fault("too_long", "messages = [\"SlaveImuDeltaTheta\"]\nfrom_s = 1\nto_s = 2\nevery = 10"),
          "--lockstep --dbc canhil-fd");
  EXPECT_THAT(flown.outcome_of("counts_match"), testing::StartsWith("pass"));
  EXPECT_EQ(causes(flown), "bad_crc bad_group frames_lost");
  EXPECT_GT(flown.report["faults"][0]["count"], 0);
}

TEST(Faults, OfSensorsAndClocksChangeWhatTheTargetReports) {
  const nlohmann::json right = fly("").report["results"];
  const std::string rate = "quantity = \"imu.rate.z\"\nfrom_s = 1\nto_s = 2\n";
  for (const std::string& one : {
           fault("bias", rate + "by_degps = 5"),
           fault("drift", rate + "by_degps = 5"),
           fault("spike", rate + "by_degps = 50\nevery = 20"),
           fault("stuck", "quantity = \"imu.specific_force.x\"\nfrom_s = 0.5\nto_s = 2"),
           fault("saturated", "quantity = \"imu.specific_force.x\"\nfrom_s = 1\nat_mps2 = 3"),
           fault("noise", rate + "sigma_degps = 5"),
           fault("reversed", "quantity = \"imu.specific_force.x\"\nfrom_s = 1"),
           fault("swapped",
                 "quantity = \"imu.specific_force.x\"\nwith = \"imu.specific_force.y\"\nfrom_s = 1"),
           fault("invalid", "node = \"slave_imu\"\nfrom_s = 1\nevery = 5"),
           fault("late", "node = \"master_ins\"\nby_ms = 50\nfrom_s = 1"),
           fault("slow", "node = \"slave_imu\"\nlonger_percent = 50\nfrom_s = 1"),
           fault("clock_step", "node = \"master_ins\"\nby_ms = -60\nfrom_s = 1"),
           fault("clock_drift", "node = \"slave_imu\"\nby_ppm = 20000\nfrom_s = 1"),
           fault("changed",
                 "messages = [\"MasterInsVelocityNE\"]\nsignal = \"velocity_north_mps\"\nvalue = 100\nfrom_s "
                 "= 1"),
       }) {
    const Flown flown = fly(one);
    EXPECT_NE(flown.report["results"], right) << one;
    EXPECT_GT(flown.report["faults"][0]["count"], 0) << one;
    EXPECT_THAT(flown.outcome_of("counts_match"), testing::StartsWith("pass")) << one;
  }
}

TEST(Faults, ABiasOfTheGyroFailsWhereTheFlightWithoutPasses) {
  EXPECT_THAT(fly("").outcome_of("error"), testing::StartsWith("pass"));
  const Flown flown =
      fly(fault("bias", "name = \"gyro\"\nquantity = \"imu.rate.z\"\nfrom_s = 1\nby_degps = 5"));
  EXPECT_EQ(flown.ended.code, 1);
  EXPECT_THAT(flown.outcome_of("error"), testing::StartsWith("fail"));
  EXPECT_THAT(flown.ended.out, HasSubstr("fault 'gyro' of the sensor: struck 201 times"));
  const auto& reported = flown.report["faults"][0];
  EXPECT_EQ(reported["name"], "gyro");
  EXPECT_EQ(reported["stage"], "sensor");
  EXPECT_EQ(reported["windows"][0]["from_s"], 1.0);
}

TEST(Faults, ATargetIsRestartedInVirtualTimeAndGoesOn) {
  const Flown flown = fly(fault("restarted", "from_s = 1.5"));
  EXPECT_TRUE(flown.report["ending"]["completed"]) << flown.report["ending"];
  EXPECT_THAT(flown.outcome_of("counts_match"), testing::StartsWith("pass"));
  EXPECT_NE(flown.report["results"], fly("").report["results"]);
}

TEST(Faults, ATargetThatIsHeldIsNotTakenForSilent) {
  const Flown paused = fly(fault("paused", "from_s = 1\nfor_s = 0.6"), "");
  EXPECT_TRUE(paused.report["ending"]["completed"]) << paused.report["ending"];
  // The target was silent for longer than 0.5 s, so the heartbeat check must not pass. On a busy host its
  // outcome may be 'not measured'.
  EXPECT_THAT(paused.outcome_of("heartbeat"),
              testing::AnyOf(testing::StartsWith("fail"), testing::StartsWith("not measured: no CPU")));
  const Flown slowed = fly(fault("slowed", "from_s = 1\nto_s = 2\ncpu_percent = 40\nperiod_ms = 100") +
                               fault("restarted", "from_s = 2.2"),
                           "");
  EXPECT_TRUE(slowed.report["ending"]["completed"]) << slowed.report["ending"];
  EXPECT_EQ(slowed.report["faults"][0]["count"], 10);
  EXPECT_EQ(slowed.report["faults"][1]["count"], 1);
}

TEST(Faults, WhatIsWrongWithThemIsSaidBeforeTheRun) {
  const auto refused = [](const std::string& faults, const std::string& how, const std::string& what) {
    expect_one_line(
        hil_bench(fmt::format("run {} --bus {} {} --faults {}", scenario("transfer_alignment_quick"), bus(),
                              how, faults_file(faults))),
        what);
  };
  refused(fault("lots", ""), "", "faults.toml:2: key 'fault[1].kind': 'lots' is unknown");
  refused("title = \"no faults\"\n", "", "key 'title': is unknown, expected");
  refused(fault("paused", "from_s = 1\nfor_s = 0.1"), "--lockstep", "'paused' has no effect in virtual time");
  refused(fault("paused", "from_s = 1\nfor_s = 0.1"), "--target none",
          "needs a target that hil-bench starts");
  refused(fault("bus_off", "from_s = 1\nfor_s = 0.1"), "", "needs error frames");
  expect_one_line(hil_bench("run " + scenario("transfer_alignment_quick") + " --faults no_such.toml"),
                  "no_such.toml");
}

}  // namespace
}  // namespace canhil::test
