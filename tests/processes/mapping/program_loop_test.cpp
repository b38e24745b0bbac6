// The autopilot of docs/examples steers a plant that is a program: docs/examples/plant/ship.py.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/processes/mapping/autopilot_loop.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

std::string ship_keys(const std::string& program = SOURCE_DIR "/docs/examples/plant/ship.py") {
  return "kind = \"program\"\ncommand = \"/usr/bin/python3 " + program +
         "\"\n[plant.parameters]\nheading_deg = 350\nspeed_mps = 8\nturn_time_constant_s = 0.4\n"
         "turn_gain_per_s = 1.2\nactuator_lag_s = 0.05\nactuator_rate_degps = 120\nactuator_stop_deg = 30\n"
         "gust_from_s = 12\ngust_to_s = 15\ngust_degps2 = 60\n";
}

// The example with a step that fails after 3 s.
std::string failing_ship() {
  std::string text = read(SOURCE_DIR "/docs/examples/plant/ship.py");
  const auto change = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  change("Path(__file__).resolve().parents[3] / \"python/canhil\"", "'" SOURCE_DIR "/python/canhil'");
  const std::string step = "    def step(self, t, dt, inputs):\n";
  change(step, step + "        if t > 3: raise ValueError('aground')\n");
  std::ofstream(own_folder() + "/failing.py") << text;
  return own_folder() + "/failing.py";
}

TEST(ProgramLoop, MovesLikeThePlantThatIsBuiltIn) {
  fly_alike({autopilot_loop("built_in.toml"), autopilot_loop("ship.toml", ship_keys())});
}

// The run ends with the reason, which is told once; the device is not blamed.
TEST(ProgramLoop, AProgramThatFailsIsNotMeasured) {
  const std::string scenario = autopilot_loop("fails.toml", ship_keys(failing_ship()));
  const Ended ended = hil_bench(fmt::format("run {} --lockstep {}", scenario, steered_by_autopilot));
  EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
  const std::string reason = "failing.py' at 3.02 s: reports 'ValueError: aground'";
  const std::size_t at = ended.out.find(reason);
  ASSERT_NE(at, std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.find(reason, at + 1), std::string::npos) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("not measured: program"));
}

// A campaign over a parameter of the program gives the same results with one thread and with two.
TEST(ProgramLoop, ACampaignSweepsItsParameters) {
  static_cast<void>(autopilot_loop("ship.toml", ship_keys()));
  const std::string campaign = own_folder() + "/ships.toml";
  std::ofstream(campaign)
      << "title = \"ships\"\nruns = 2\nseed = 5\n[[variant]]\nname = \"ship\"\n"
         "scenario = \"ship.toml\"\n[sweep]\n\"plant.parameters.turn_gain_per_s\" = [1.0, "
         "1.4]\n[[metric]]\nkind = \"distribution\"\nname = \"heading\"\n"
         "quantity = \"attitude.heading\"\nat_s = 3.0\nrms_at_most_mrad = 20.0\n";
  std::vector<std::string> exported;
  for (const int threads : {1, 2}) {
    const std::string results = fmt::format("{}/ships{}.sqlite", own_folder(), threads);
    const Ended flown = hil_bench(fmt::format("campaign {} {} --threads {} --out {}", campaign,
                                              steered_by_autopilot, threads, results));
    EXPECT_EQ(flown.code, 0) << flown.err << flown.out;
    exported.push_back(hil_bench("campaign export " + results).out);
  }
  EXPECT_THAT(exported[0], HasSubstr("plant.parameters.turn_gain_per_s=1.4"));
  EXPECT_EQ(exported[0], exported[1]);
}

}  // namespace
}  // namespace canhil::test
