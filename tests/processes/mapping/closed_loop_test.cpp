// The autopilot of docs/examples steers its plant.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string autopilot = SOURCE_DIR "/docs/examples/autopilot/";
const std::string autopilot_target =
    "--target '/usr/bin/python3 " SOURCE_DIR "/docs/examples/autopilot/autopilot.py";

// The scenario with changes; returns its path.
std::string changed_loop(const std::string& name,
                         const std::vector<std::pair<std::string, std::string>>& changes) {
  std::string text = read(autopilot + "autopilot.toml");
  for (const auto& [from, to] : changes) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  const std::string mapping = "autopilot.mapping.toml";
  text.replace(text.find(mapping), mapping.size(), autopilot + mapping);
  std::ofstream(scratch(name)) << text;
  return scratch(name);
}

std::map<std::string, std::string> outcomes_of(const std::string& report) {
  std::map<std::string, std::string> outcomes;
  const nlohmann::json seen = read_json(report);
  for (const auto& check : seen["checks"]) outcomes[check["name"]] = check["outcome"];
  return outcomes;
}

// An actuator that reaches its stop turns the craft too slowly, and the autopilot says that it does not
// follow.
TEST(ClosedLoop, AnActuatorAtItsStopFails) {
  const std::string stops = changed_loop("stops.toml", {{"actuator_stop_deg = 30", "actuator_stop_deg = 6"}});
  const std::string report = scratch("stops.json");
  const Ended ended =
      hil_bench(fmt::format("run {} --lockstep {}' --json {}", stops, autopilot_target, report));
  EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
  auto outcomes = outcomes_of(report);
  EXPECT_EQ(outcomes["response settling_time of attitude.heading"], "fail");
  EXPECT_EQ(outcomes["flag no rudder_fault"], "fail");
  EXPECT_EQ(outcomes["command age of rudder"], "pass");
}

// The example with an AP_Rudder that answers nothing, and with these checks; returns the path of the
// scenario.
std::string unanswering_rudder(const std::string& name, const std::string& checks) {
  std::string text = read(autopilot + "autopilot.toml"), map = read(autopilot + "autopilot.mapping.toml");
  const std::string owes =
      "message = \"AP_Rudder\"\nanswers = \"HDG_Heading\"\necho = { signal = \"AP_HeadingCounter\", of = "
      "\"HDG_Heading.HDG_Counter\" }\n";
  EXPECT_NE(map.find(owes), std::string::npos);
  map.replace(map.find(owes), owes.size(), "message = \"AP_Rudder\"\n");
  const std::string dbc = "dbc = \"autopilot.dbc\"";
  map.replace(map.find(dbc), dbc.size(), "dbc = \"" + autopilot + "autopilot.dbc\"");
  std::ofstream(scratch(name + ".mapping.toml")) << map;
  text.replace(text.find("autopilot.mapping.toml"), 22, name + ".mapping.toml");
  text.replace(text.find("[[check]]"), std::string::npos, checks);
  std::ofstream(scratch(name + ".toml")) << text;
  return scratch(name + ".toml");
}

// A device that answers, but never commands: without a check of the loop too, the run fails, and so does a
// campaign.
TEST(ClosedLoop, WithoutACommandItFails) {
  const std::string silent = scratch("silent.py");
  std::string device = read(autopilot + "autopilot.py");
  const std::string yields = "            yield COMMAND, frame\n        else",
                    folder_of_kit = "str(Path(__file__).resolve().parents[1] / \"kit\")";
  ASSERT_NE(device.find(yields), std::string::npos);
  device.replace(device.find(yields), yields.size(), "            pass\n        else");
  device.replace(device.find(folder_of_kit), folder_of_kit.size(), "\"" SOURCE_DIR "/docs/examples/kit\"");
  std::ofstream(silent) << device;
  const std::string scenario = unanswering_rudder(
      "silent", "[[check]]\nkind = \"error\"\nquantity = \"attitude.heading\"\nbelow_deg = 0.1\n");
  const std::string target = fmt::format("--target '/usr/bin/python3 {}'", silent);
  const Ended ended = hil_bench(fmt::format("run {} --lockstep {}", scenario, target));
  EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
  EXPECT_THAT(ended.out, testing::ContainsRegex("FAIL +commands +no command of rudder came"));
  std::ofstream(scratch("silent_campaign.toml"))
      << "title = \"open loop\"\nruns = 2\nseed = 1\n[[variant]]\nname = \"it\"\nscenario = \"silent.toml\"\n"
         "[[metric]]\nkind = \"distribution\"\nname = \"heading\"\nquantity = \"attitude.heading\"\n"
         "at_s = 3.0\nrms_at_most_mrad = 1000.0\n";
  const Ended campaign = hil_bench(fmt::format("campaign {} {} --out {}", scratch("silent_campaign.toml"),
                                               target, scratch("silent.sqlite")));
  EXPECT_EQ(campaign.code, 1) << campaign.out << campaign.err;
  EXPECT_THAT(campaign.out, HasSubstr("no command of rudder came"));
}

// Lockstep waits for answers. If the command comes in a message that answers nothing, its time of arrival is
// that of the host.
TEST(ClosedLoop, LockstepThatDoesNotWaitForTheCommandIsNotMeasured) {
  const std::string scenario = unanswering_rudder(
      "unawaited",
      "[[check]]\nkind = \"response\"\nquantity = \"attitude.heading\"\nstatistic = \"steady_error\"\n"
      "setpoint_deg = 20\nbelow_deg = 90\nfrom_s = 8\n");
  const std::string report = scratch("unawaited.json");
  const Ended ended =
      hil_bench(fmt::format("run {} --lockstep {}' --json {}", scenario, autopilot_target, report));
  EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
  const nlohmann::json seen = read_json(report);
  EXPECT_THAT(seen["checks"][0]["measured"].get<std::string>(), HasSubstr("does not wait for AP_Rudder"));
  EXPECT_EQ(seen["checks"][0]["outcome"], "not measured");
}

// 60 ms from the arrival of a command to its effect: the delay is found in virtual time too.
TEST(ClosedLoop, ADelayOfTheCommandFails) {
  const std::string late =
      changed_loop("late.toml", {{"timeout_ms = 200", "delay_ms = 60\ntimeout_ms = 200"}});
  const std::string report = scratch("late.json");
  const Ended ended =
      hil_bench(fmt::format("run {} --lockstep {}' --json {}", late, autopilot_target, report));
  EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
  auto outcomes = outcomes_of(report);
  EXPECT_EQ(outcomes["command delay of rudder"], "fail");
  EXPECT_EQ(outcomes["response overshoot of attitude.heading"], "fail");
}

// A device that answers 60 ms late, in real time. The host may be too late to judge (3), but it never passes.
TEST(ClosedLoop, ALateDeviceFailsByItsDelay) {
  const std::string report = scratch("late_device.json");
  const Ended ended = hil_bench(
      fmt::format("run {}autopilot.toml {} --defect late' --json {}", autopilot, autopilot_target, report));
  EXPECT_THAT(ended.code, testing::AnyOf(1, 3)) << ended.out << ended.err;
  auto outcomes = outcomes_of(report);
  EXPECT_NE(outcomes["command delay of rudder"], "pass");
  EXPECT_NE(outcomes["latency AP_Rudder"], "pass");
  EXPECT_NE(outcomes["response overshoot of attitude.heading"], "pass");
  EXPECT_EQ(outcomes["flag engaged"], "pass");
}

// The same bits in each run of lockstep and on each bus, and the log gives the same verdict again.
TEST(ClosedLoop, LockstepHasTheSameBitsOnEachBusAndInItsLog) {
  std::vector<std::string> frames;
  for (const std::string& where : {std::string("one"), std::string("two")}) {
    const std::string log = scratch(where + ".log");
    const Ended ended =
        hil_bench(fmt::format("run {}autopilot.toml --lockstep --bus {}-{} {}' --log {} --json {}", autopilot,
                              bus(), where, autopilot_target, log, scratch(where + ".json")));
    ASSERT_EQ(ended.code, 3) << ended.out << ended.err;
    std::istringstream lines(read(log));
    std::string all;
    for (std::string line; std::getline(lines, line);) all += line.substr(line.rfind(' ')) + "\n";
    frames.push_back(all);
  }
  EXPECT_GT(frames[0].size(), 10'000U);
  EXPECT_EQ(frames[0], frames[1]);
  const Ended checked = hil_bench(fmt::format("check {} {}autopilot.toml --json {}", scratch("one.log"),
                                              autopilot, scratch("checked.json")));
  EXPECT_EQ(checked.code, 3) << checked.out << checked.err;
  EXPECT_EQ(outcomes_of(scratch("checked.json")), outcomes_of(scratch("one.json")));
}

TEST(ClosedLoop, TheLogOfARealTimeRunIsRefused) {
  const std::string log = scratch("real.log");
  ASSERT_NE(
      hil_bench(fmt::format("run {} {}' --log {}",
                            changed_loop("short.toml", {{"duration_s = 30.0", "duration_s = 2.0"},
                                                        {"to_s = 12", "to_s = 1"},
                                                        {"to_s = 12", "to_s = 1"},
                                                        {"from_s = 12\nto_s = 20", "from_s = 1\nto_s = 2"},
                                                        {"from_s = 24", "from_s = 1.5"},
                                                        {"gust_s = [12, 15]", "gust_s = [1, 2]"}}),
                            autopilot_target, log))
          .code,
      2);
  const Ended checked = hil_bench(fmt::format("check {} {}", log, scratch("short.toml")));
  EXPECT_EQ(checked.code, 2);
  EXPECT_THAT(checked.err, HasSubstr("is of a run in real time"));
}

// A program that takes 30 ms for each step of 10 ms: in real time its loop is another one, which proves
// nothing.
TEST(ClosedLoop, ASlowPlantIsNotMeasuredInRealTime) {
  const std::string slow = scratch("slow.py");
  std::ofstream(slow) << "import sys, time\nsys.path.append('" SOURCE_DIR
                         "/python/canhil')\nimport partner\n"
                         "class Slow:\n"
                         "  inputs = {'rudder': 'rad'}\n"
                         "  outputs = {'attitude.heading': 'rad turns', 'rudder': 'rad'}\n"
                         "  def __init__(self): self.heading = 0.349\n"
                         "  def values(self): return [self.heading, 0.0]\n"
                         "  def step(self, t, dt, inputs): time.sleep(0.03)\n"
                         "partner.serve(Slow)\n";
  std::string text = read(autopilot + "autopilot.toml");
  const std::size_t from = text.find("kind = \"steered_heading\""), to = text.find("[plant.commands.rudder]");
  text.replace(from, to - from, fmt::format("kind = \"program\"\ncommand = \"/usr/bin/python3 {}\"\n", slow));
  const std::size_t checks = text.find("[[check]]");
  text.replace(
      checks, std::string::npos,
      "[[check]]\nkind = \"response\"\nquantity = \"attitude.heading\"\nstatistic = \"steady_error\"\n"
      "setpoint_deg = 20\nbelow_deg = 10\n");
  const std::string mapping = "autopilot.mapping.toml";
  text.replace(text.find(mapping), mapping.size(), autopilot + mapping);
  text.replace(text.find("duration_s = 30.0"), 17, "duration_s = 2.0");
  std::ofstream(scratch("slow.toml")) << text;
  const Ended ended = hil_bench(fmt::format("run {} {}'", scratch("slow.toml"), autopilot_target));
  EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("more than a step of the plant"));
  EXPECT_EQ(hil_bench(fmt::format("run {} --lockstep {}'", scratch("slow.toml"), autopilot_target)).code, 0)
      << "in virtual time it only takes longer";
}

// Whoever opens a scenario with a program runs it: the option refuses that before it starts.
TEST(ClosedLoop, APlantThatIsAProgramIsRefusedWithoutCommands) {
  const std::string was = scratch("was_started");
  const std::string touches = changed_loop(
      "touches.toml",
      {{"kind = \"steered_heading\"", fmt::format("kind = \"program\"\ncommand = \"touch {}\"", was)}});
  expect_one_line(hil_bench(fmt::format("run {} --lockstep --no-commands {}'", touches, autopilot_target)),
                  "is a program ('touch");
  std::ifstream none(was);
  EXPECT_FALSE(none.good());
}

// The outputs of the plant and the commands are in the CSV and in the page.
TEST(ClosedLoop, TheReportShowsThePlant) {
  const std::string csv = scratch("plant.csv"), page = scratch("plant.html");
  ASSERT_EQ(hil_bench(fmt::format("run {}autopilot.toml --lockstep {}' --csv {} --html {}", autopilot,
                                  autopilot_target, csv, page))
                .code,
            3);
  const std::string rows = read(csv), shown = read(page);
  for (const char* const row : {"\n0.010000,plant,plant.attitude.heading,rad,,",
                                "\n30.000000,plant,plant.rudder,rad,,", ",autopilot,rudder.command,rad,"})
    EXPECT_NE(rows.find(row), std::string::npos) << row;
  // The first command comes at 0.02 s.
  for (const char* const part :
       {"aria-label=\"plant.rudder\"", "1500 commands, 0 without a value, 2 steps without one in time"})
    EXPECT_NE(shown.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace canhil::test
