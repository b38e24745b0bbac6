// Tests that each error in a table [[fault]] gives one line, and that docs/faults.md lists all kinds of
// faults.
#include <regex>

#include "bench/faults/kinds.hpp"
#include "tests/unit/bench/faults/flown_with_faults.hpp"

namespace canhil::faults {
namespace {

using testing::HasSubstr;

TEST(ReadFaults, WhatIsWrongIsSaidInOneLine) {
  const std::string theta = "messages = [\"SlaveImuDeltaTheta\"]\n";
  const std::string of_rate = "quantity = \"imu.rate.z\"\n";
  const std::vector<std::pair<std::string, std::string>> wrong{
      {fault("lostt", theta), "key 'fault[1].kind': 'lostt' is unknown, expected 'lost'"},
      {fault("lost", "messages = [\"AlignUpdate\"]"),
       "key 'fault[1].messages': 'AlignUpdate' is unknown, expected one of: SlaveImuDeltaTheta"},
      {fault("lost", ""),
       "key 'fault[1].messages': is missing, expected some that a node of the scenario sends, or node"},
      {fault("lost", theta + "node = \"slave_imu\""), "key 'fault[1].messages': is given beside node"},
      {fault("lost", "node = \"gps\""),
       "key 'fault[1].node': 'gps' is unknown, expected one of: master_ins, slave_imu"},
      {fault("lost", theta + "from_s = 9"), "key 'fault[1].from_s': is after the end of the run"},
      {fault("bias", of_rate + "by_dgps = 1"), "key 'fault[1].by_dgps': is unknown, expected 'by_degps'"},
      {fault("lost", theta + "signal = \"x\""), "key 'fault[1].signal': is unknown"},
      {fault("lost", theta + "from_s = 2\nto_s = 1"), "key 'fault[1].to_s': is before from_s"},
      {fault("lost", theta + "each_s = 1"), "key 'fault[1].each_s': is given alone"},
      {fault("lost", theta + "for_s = 2\neach_s = 1"), "key 'fault[1].for_s': is longer than each_s"},
      {fault("lost", theta + "for_s = 2\nto_s = 1"), "key 'fault[1].for_s': is given beside to_s"},
      {fault("lost", theta + "percent = 101"), "key 'fault[1].percent': 101 is out of range"},
      {fault("lost", theta + "name = \"a\"\n") + fault("lost", theta + "name = \"a\""),
       "key 'fault[2].name': 'a' is the name of fault[1] too"},
      {fault("changed", theta + "signal = \"none\"\nvalue = 1"),
       "key 'fault[1].signal': SlaveImuDeltaTheta has no signal 'none'"},
      {fault("changed", theta + "signal = \"delta_theta_x_rad\"\nvalue = 5"),
       "is 5, expected -0.131 to 0.131"},
      {fault("bias", of_rate),
       "key 'fault[1].by_degps': is missing, expected one of: by_degps, by_mradps, by_degph"},
      {fault("bias", of_rate + "by_mps = 1\nby_degps = 1"), "key 'fault[1].by_mps': is unknown"},
      {fault("bias", of_rate + "by_mradps = 1\nby_degps = 1"),
       "is given beside by_degps, expected one of the two"},
      {fault("bias", "quantity = \"gps.height\"\nby_m = 1"),
       "key 'fault[1].quantity': 'gps.height' is unknown"},
      {fault("bias", "by = 1"),
       "key 'fault[1].quantity': is missing, expected a quantity, or messages and signal"},
      {fault("saturated", of_rate + "at_degps = -1"), "key 'fault[1].at_degps': -1 is out of range"},
      {fault("spike", of_rate + "by_degps = 1"),
       "key 'fault[1].every': is missing: a spike at each sample is a bias"},
      {fault("swapped", of_rate + "with = \"imu.specific_force.x\""),
       "key 'fault[1].with': 'imu.specific_force.x' is not like 'imu.rate.z'"},
      {fault("invalid", "quantity = \"slave_imu.temperature\""), "expected"},
      {fault("counter_jump", theta + "by = 15"),
       "key 'fault[1].by': 15 is a whole turn of the counter or more"},
      {fault("stranger", "period_ms = 10\nid = 130"), "key 'fault[1].id': 130 is used by the DBC"},
      {fault("flood", "period_us = 100\nload_percent = 3"),
       "key 'fault[1].load_percent': is given beside period_us"},
      {fault("paused", "from_s = 1"), "key 'fault[1].for_s': is missing, expected how long it lasts"},
      {fault("paused", "from_s = 1\nfor_s = 2"),
       "key 'fault[1].for_s': lasts to the end of the run or longer"},
      {fault("restarted", "from_s = 9"), "key 'fault[1].from_s': is after the end of the run"},
      {fault("restart", "node = \"slave_imu\"\nfrom_s = 9\nsilent_s = 1"),
       "key 'fault[1].from_s': is after the end of the run"},
  };
  for (const auto& [text, what] : wrong) {
    const std::string said = refusal(text);
    EXPECT_THAT(said, HasSubstr(what)) << text;
    EXPECT_THAT(said, testing::StartsWith("test.toml:")) << text;
    EXPECT_EQ(said.find('\n'), std::string::npos) << text;
  }
}

TEST(ReadFaults, ANameIsUniqueByDefault) {
  const std::string one = fault("lost", "messages = [\"SlaveImuDeltaV\"]\n");
  const auto scenario = parsed(one + one + fault("silent", "node = \"slave_imu\"")).value();
  EXPECT_EQ(scenario.faults.at(0).name, "lost SlaveImuDeltaV");
  EXPECT_EQ(scenario.faults.at(1).name, "lost SlaveImuDeltaV 2");
  EXPECT_EQ(scenario.faults.at(2).name, "silent slave_imu");
}

TEST(ReadFaults, WhatCannotWorkSomewhereSaysWhy) {
  const auto why = [](const std::string& text, const Place& place) {
    const auto scenario = parsed(text).value();
    const auto works = check(scenario.faults, place);
    return works ? std::string() : works.error().message;
  };
  const Place local{.bus = "local:x", .starts_target = true};
  Place lockstep = local;
  lockstep.virtual_time = true;
  Place controller = everything;
  controller.interface = Place::Interface::controller;
  Place mapped = everything;
  mapped.handshake = false;
  const std::string paused = fault("paused", "from_s = 1\nfor_s = 0.1");
  EXPECT_EQ(why(paused, local), "");
  EXPECT_THAT(why(paused, lockstep),
              HasSubstr("key 'fault[1].kind': 'paused' has no effect in virtual time"));
  EXPECT_THAT(why(paused, {}), HasSubstr("needs a target that hil-bench starts"));
  EXPECT_THAT(why(paused, {.in_process = true}), HasSubstr("needs a process"));
  const std::string off = fault("bus_off", "from_s = 1\nfor_s = 0.1");
  EXPECT_EQ(why(off, everything), "");
  EXPECT_THAT(why(off, local), HasSubstr("needs error frames, which 'local:x' does not carry"));
  EXPECT_THAT(why(off, controller), HasSubstr("can only be reported by a controller's driver"));
  const std::string down = fault("interface_down", "from_s = 1\nfor_s = 0.1");
  EXPECT_THAT(why(down, local), HasSubstr("needs an interface"));
  controller.may_set_interface = false;
  EXPECT_THAT(why(down, controller), HasSubstr("CAP_NET_ADMIN"));
  EXPECT_THAT(why(fault("flood", "load_percent = 10"), local), HasSubstr("does not know the bit rate"));
  EXPECT_THAT(why(fault("too_long", "messages = [\"SlaveImuDeltaV\"]"), local),
              HasSubstr("has no longer frame for the 8 bytes of SlaveImuDeltaV"));
  for (const char* of_a_sensor :
       {"late\"\nby_ms = 1", "slow\"\nlonger_percent = 10", "clock_step\"\nby_ms = 1"})
    EXPECT_EQ(
        why(std::string("[[fault]]\nname = \"f\"\nnode = \"slave_imu\"\nkind = \"") + of_a_sensor + "\n",
            mapped),
        "");
  EXPECT_THAT(why(fault("restarted", "from_s = 1"), mapped), HasSubstr("has no handshake in a mapping"));
}

TEST(ReadFaults, ThePageHasEveryKindWithItsStage) {
  std::stringstream page;
  page << std::ifstream(SOURCE_DIR "/docs/faults.md").rdbuf();
  const std::string text = page.str();
  const std::regex row(R"(\n\| `(\w+)` \| (\w+) \| (?:each|stretch|`))");
  std::vector<std::string> written, known;
  for (std::sregex_iterator at(text.begin(), text.end(), row), end; at != end; ++at)
    written.push_back((*at)[1].str() + " " + (*at)[2].str());
  for (const Listed& one : listed_kinds())
    known.push_back(std::string(one.kind.name) + " " + std::string(name(one.stage)));
  EXPECT_EQ(written, known);
}

TEST(ReadFaults, EveryKindIsFlownBetweenTwoProcesses) {
  std::stringstream tests;
  for (const char* file : {"processes/hil/faults_test.cpp", "vcan/outages_test.cpp"})
    tests << std::ifstream(fmt::format("{}/tests/{}", SOURCE_DIR, file)).rdbuf();
  for (const Listed& one : listed_kinds()) {
    EXPECT_TRUE(std::regex_search(tests.str(), std::regex(fmt::format("\\\\?\"{}\\\\?\"", one.kind.name))))
        << one.kind.name;
  }
}

}  // namespace
}  // namespace canhil::faults
