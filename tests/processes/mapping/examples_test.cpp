// The devices of docs/examples in the style of real ones. Each passes, and each defect fails the check that
// is there for it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::Contains;
using testing::IsEmpty;

struct DeviceDefect {
  std::string device, defect, fails;
};
// The name of a test.
void PrintTo(const DeviceDefect& of, std::ostream* out) { *out << of.device << ' ' << of.defect; }

class Device {
 public:
  explicit Device(std::string name) : name_(std::move(name)) {}
  [[nodiscard]] Ended fly(const std::string& defect, const std::string& more) const {
    return hil_bench(
        fmt::format("run {0}/docs/examples/{1}/{1}.toml --target '/usr/bin/python3 "
                    "{0}/docs/examples/{1}/{1}.py --defect {2}' {3} "
                    "--json {4}",
                    SOURCE_DIR, name_, defect, more, report_));
  }
  [[nodiscard]] nlohmann::json report() const { return read_json(report_); }
  [[nodiscard]] std::vector<std::string> checks(const std::string& outcome) const {
    std::vector<std::string> names;
    const nlohmann::json seen = report();
    for (const auto& check : seen["checks"]) {
      if (check["outcome"] == outcome) names.push_back(check["name"]);
    }
    return names;
  }

 private:
  std::string name_, report_ = scratch("device.json");
};

class Devices : public testing::TestWithParam<std::string> {};

// Virtual time measures no times.
TEST_P(Devices, PassInLockstep) {
  const Device device(GetParam());
  const Ended ended = device.fly("none", "--lockstep");
  EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
  EXPECT_THAT(device.checks("fail"), IsEmpty()) << ended.out;
  EXPECT_GE(device.checks("pass").size(), 8U);
}

TEST_P(Devices, PassInRealTime) {
  const Device device(GetParam());
  const Ended ended = device.fly("none", "--bus " + bus());
  ASSERT_NE(ended.code, 2) << ended.err;
  expect_outputs_passed(ended, device.report());
}

// The GNSS receiver of the car is on a bus of its own. The car listens on both.
TEST(DeviceBuses, EachNodeSendsOnItsOwn) {
  const Device device("car");
  const std::string log = scratch("car.log"), first = fmt::format("local:car-{}", getpid()),
                    second = first + "-gnss";
  const Ended ended =
      device.fly("none", fmt::format("--bus {} --bus-of gnss={} --log {}", first, second, log));
  ASSERT_NE(ended.code, 2) << ended.err;
  expect_outputs_passed(ended, device.report());
  std::map<std::string, std::map<std::string, int>> frames;  // by id and bus
  std::istringstream lines(read(log));
  for (std::string line; std::getline(lines, line);) {
    std::string stamp, on, frame;
    std::istringstream(line) >> stamp >> on >> frame;
    ++frames[frame.substr(0, 3)][on];
  }
  EXPECT_EQ(frames["120"].size(), 1U);
  EXPECT_GT(frames["120"][second], 140);
  EXPECT_EQ(frames["121"].size(), 1U);
  EXPECT_EQ(frames["100"].size(), 1U);
  EXPECT_GT(frames["100"][first], 2900);
  EXPECT_EQ(frames["200"].count(second), 0U);
  const Ended unknown = device.fly("none", fmt::format("--bus {} --bus-of radar={}", first, second));
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, testing::HasSubstr("one of Sensors, Gnss"));
}

// A flag in the CSV, the JSON and the page: its first answer, and each change.
TEST(DeviceReports, ShowWhenFlagsWereSet) {
  const std::string csv = scratch("uav.csv"), page = scratch("uav.html");
  const Device device("uav");
  ASSERT_EQ(device.fly("none", fmt::format("--lockstep --csv {} --html {}", csv, page)).code, 3);
  const nlohmann::json report = device.report();
  const auto& flags = report["flags"];
  const auto found = std::ranges::find_if(flags, [](const auto& one) { return one["name"] == "imu_b_out"; });
  ASSERT_NE(found, flags.end());
  EXPECT_EQ((*found)["change_count"], 3);
  const auto& changes = (*found)["changes"];
  EXPECT_EQ(changes[0][1], false);
  EXPECT_NEAR(changes[1][0].get<double>(), 20.25, 0.25) << "the fault begins at 20 s";
  EXPECT_NEAR(changes[2][0].get<double>(), 26, 1) << "and ends at 25 s";
  const std::string rows = read(csv);
  EXPECT_EQ(rows.find(",imu_a_out,flag,1"), std::string::npos);
  EXPECT_NE(rows.find(",imu_b_out,flag,1"), std::string::npos);
  EXPECT_NE(read(page).find("aria-label=\"Flags\""), std::string::npos);
}

// What events sent, and when, depends on the device: the log alone says it. In a log, no times are judged.
TEST(DeviceLog, HasTheAnswersToEvents) {
  for (const char* const manner : {"--lockstep", ""}) {
    const std::string log = scratch("odometer.log"), report = scratch("odometer.json");
    const Device device("odometer");
    ASSERT_NE(device.fly("no_code", fmt::format("{} --log {}", manner, log)).code, 2);
    const Ended ended = hil_bench(
        fmt::format("check {} {}/docs/examples/odometer/odometer.toml --json {}", log, SOURCE_DIR, report));
    EXPECT_EQ(ended.code, 1) << ended.err;
    for (const auto& [name, outcome] : std::map<std::string, std::string>{{"measures", "pass"},
                                                                          {"serial number", "pass"},
                                                                          {"no trouble code", "pass"},
                                                                          {"trouble code", "fail"},
                                                                          {"cleared", "pass"}}) {
      const nlohmann::json seen = read_json(report);
      const auto& checks = seen["checks"];
      const auto found =
          std::ranges::find_if(checks, [&key = name](const auto& one) { return one["name"] == key; });
      ASSERT_NE(found, checks.end()) << name;
      EXPECT_EQ((*found)["outcome"], outcome) << name << ": " << (*found)["measured"];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, Devices,
                         testing::Values("auv", "autopilot", "car", "hover", "marine", "odometer", "uav"),
                         [](const auto& of) { return of.param; });

// The ship's navigator, but its position is a message of J1939: PGN 65259, announced to all nodes (BAM),
// seven packets.
class J1939Navigator {
 public:
  J1939Navigator() {
    const std::string position = "2381841700", group = std::to_string(0x98FEEB24U);
    change("marine.dbc",
           {{position, group},
            {"BA_DEF_DEF_ \"GenMsgCycleTime\" 0;",
             "BA_DEF_DEF_ \"GenMsgCycleTime\" 0;\nBA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\","
             "\"ExtendedCAN\",\"reserved\",\"J1939PG\";\nBA_DEF_DEF_ \"VFrameFormat\" \"ExtendedCAN\";\n"
             "BA_ \"VFrameFormat\" BO_ " +
                 group + " 3;"}});
    change("marine.mapping.toml", {});
    change("marine.toml", {});
    change(
        "marine.py",
        {{"str(Path(__file__).resolve().parents[1] / \"kit\")", "\"" SOURCE_DIR "/docs/examples/kit\""},
         {"enumerate(self.out.split(message))",
          "enumerate([bytes([32, 43, 0, 7, 255, 0xEB, 0xFE, 0])] + [bytes([i + 1]) + message[7 * i:7 * i + "
          "7].ljust(7, b'\\xff') for i in range(7)])"},
         {"yield POSITION, frame", "yield EXTENDED | (0x1CEBFF24 if number else 0x1CECFF24), frame"}});
  }
  [[nodiscard]] Ended fly(const std::string& defect, const std::string& more) const {
    return hil_bench(fmt::format(
        "run {0}/marine.toml --lockstep --target '/usr/bin/python3 {0}/marine.py --defect {1}' {2}",
        scratch(""), defect, more));
  }

 private:
  static void change(const std::string& file,
                     const std::vector<std::pair<std::string, std::string>>& changes) {
    std::string text = read(SOURCE_DIR "/docs/examples/marine/" + file);
    for (const auto& [from, to] : changes) {
      ASSERT_NE(text.find(from), std::string::npos) << from;
      for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    }
    std::ofstream(scratch(file)) << text;
  }
};

TEST(MessagesOfJ1939, OfSeveralFramesAreHeard) {
  const J1939Navigator navigator;
  const std::string log = scratch("j1939.log");
  const Ended right = navigator.fly("none", "--log " + log);
  EXPECT_THAT(right.out, testing::ContainsRegex("PASS +error position.horizontal")) << right.err;
  EXPECT_THAT(right.out, testing::HasSubstr("lost by the counter 0 "));
  EXPECT_THAT(hil_bench(fmt::format("check {} {}", log, scratch("marine.toml"))).out,
              testing::ContainsRegex("PASS +error position.horizontal"));
  EXPECT_THAT(navigator.fly("lost_frame", "").out,
              testing::ContainsRegex("FAIL +protection +.*lost by the counter [1-9]"));
}

class DeviceDefects : public testing::TestWithParam<DeviceDefect> {};

TEST_P(DeviceDefects, FailTheirCheck) {
  const auto& [name, defect, fails] = GetParam();
  const Device device(name);
  const Ended ended = device.fly(defect, "--lockstep");
  EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
  EXPECT_THAT(device.checks("fail"), Contains(fails)) << ended.out;
}

INSTANTIATE_TEST_SUITE_P(
    Each, DeviceDefects,
    testing::Values(DeviceDefect{"auv", "dvl_backwards", "error velocity.norm"},
                    DeviceDefect{"auv", "inverse_quaternion", "error attitude.heading"},
                    DeviceDefect{"auv", "no_declination", "error attitude.heading"},
                    DeviceDefect{"auv", "depth_upwards", "error position.down"},
                    DeviceDefect{"auv", "says_dvl", "detected_within no bottom lock"},
                    DeviceDefect{"car", "yaw_sign", "error attitude.heading"},
                    DeviceDefect{"car", "wheels_in_kmph", "error velocity.north"},
                    DeviceDefect{"car", "late", "delay attitude.heading"},
                    DeviceDefect{"car", "no_flag", "flag yaw_implausible at yaw rate off"},
                    DeviceDefect{"car", "course_as_signed", "error course rms"},
                    DeviceDefect{"marine", "turns_left", "error attitude.heading"},
                    DeviceDefect{"marine", "latitude_in_radians", "error position.horizontal"},
                    DeviceDefect{"marine", "lost_frame", "protection"},
                    DeviceDefect{"marine", "never_estimated", "flag estimated at no GNSS position"},
                    DeviceDefect{"marine", "wrong_sid", "causes"},
                    DeviceDefect{"autopilot", "old_heading", "response overshoot of attitude.heading"},
                    DeviceDefect{"autopilot", "wrong_sign", "response settling_time of attitude.heading"},
                    DeviceDefect{"autopilot", "stuck", "holds through the gust"},
                    DeviceDefect{"autopilot", "no_integral", "comes back to the course"},
                    DeviceDefect{"hover", "old_attitude", "turns to east"},
                    DeviceDefect{"hover", "no_integral", "flies north"},
                    DeviceDefect{"hover", "ignores_heading", "flies north"},
                    DeviceDefect{"hover", "weak_motors", "climbs"},
                    DeviceDefect{"hover", "never_holding", "flag holding"},
                    DeviceDefect{"hover", "turns_away", "turns to east"},
                    DeviceDefect{"odometer", "own_measures", "error ground_speed"},
                    DeviceDefect{"odometer", "no_code", "trouble code"},
                    DeviceDefect{"odometer", "lost_frame", "serial number"},
                    DeviceDefect{"odometer", "keeps_code", "cleared"},
                    DeviceDefect{"odometer", "knows_all", "unknown identifier"},
                    DeviceDefect{"uav", "never_excludes", "flag imu_b_out at gyro of IMU B off"},
                    DeviceDefect{"uav", "excludes_the_other", "flag no imu_a_out"},
                    DeviceDefect{"uav", "inverse_quaternion", "error attitude.heading"},
                    DeviceDefect{"uav", "late", "delay rate.z"},
                    DeviceDefect{"uav", "ignores_qnh", "error position.height"},
                    DeviceDefect{"uav", "counter_stuck", "protection"}),
    [](const auto& of) { return of.param.device + "_" + of.param.defect; });

}  // namespace
}  // namespace canhil::test
