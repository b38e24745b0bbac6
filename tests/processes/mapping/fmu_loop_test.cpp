// The autopilot of docs/examples steers an FMU.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "tests/processes/mapping/autopilot_loop.hpp"
#include "tests/unit/bench/plant/heading_fmu.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

std::string fmu_loop(const std::string& name, const std::string& plant) {
  return autopilot_loop(name, plant, "rudder_angle");
}

std::string fmu_keys(const std::string& more = "") {
  constexpr double deg = 3.14159265358979323846 / 180;
  return fmt::format(
      "kind = \"fmu\"\nfile = \"{}/model.fmu\"\nstep_ms = 10\n{}[plant.parameters]\nheading = {}\nspeed = 8\n"
      "time_constant = 0.4\ngain = 1.2\nlag = 0.05\nrate_limit = {}\nstop = {}\ngust = {}\ngust_from = 12\n"
      "gust_to = 15\n",
      own_folder(), more, 350 * deg, 120 * deg, 30 * deg, 60 * deg);
}

class FmuLoops : public testing::TestWithParam<int> {};

TEST_P(FmuLoops, MovesLikeThePlantThatIsBuiltIn) {
  const std::string model = fmt::format("heading{}", GetParam());
  write_fmu(GetParam(), model, heading_description(GetParam(), model));
  const auto flown = fly_alike({autopilot_loop("built_in.toml"), fmu_loop("fmu.toml", fmu_keys()),
                                fmu_loop("here.toml", fmu_keys("in_process = true\n"))});
  EXPECT_EQ(flown[1], flown[2]) << "the same bits in another process";
}

INSTANTIATE_TEST_SUITE_P(Each, FmuLoops, testing::Values(2, 3));

// A step that fails ends the run with the name of the FMU; the device is not blamed.
TEST(FmuLoop, AnFmuThatFailsIsNotMeasured) {
  write_fmu(2, "heading2", heading_description(2, "heading2"));
  std::string keys = fmu_keys();
  const std::string lag = "time_constant = 0.4";
  keys.replace(keys.find(lag), lag.size(),
               "time_constant = 1e-300");  // its turn rate leaves the range of numbers
  const std::string log = scratch("fails.log");
  const Ended ended = hil_bench(
      fmt::format("run {} --lockstep {} --log {}", fmu_loop("fails.toml", keys), steered_by_autopilot, log));
  EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("not measured: "));
  EXPECT_THAT(ended.out, HasSubstr("model.fmu"));
  const std::string frames = read(log);
  EXPECT_EQ(frames.find(" 100#"), frames.rfind(" 100#")) << "a heading that moves no more is not sent";
  // A campaign of such runs does not blame the device either.
  std::ofstream(own_folder() + "/fails_campaign.toml")
      << "title = \"fails\"\nruns = 2\nseed = 1\n[[variant]]\nname = \"FMU\"\nscenario = "
         "\"fails.toml\"\n[[metric]]\n"
         "kind = \"distribution\"\nname = \"heading\"\nquantity = \"attitude.heading\"\nat_s = 3.0\n"
         "rms_at_most_mrad = 20.0\n";
  const Ended campaign = hil_bench(fmt::format("campaign {0}/fails_campaign.toml {1} --out {0}/fails.sqlite",
                                               own_folder(), steered_by_autopilot));
  EXPECT_EQ(campaign.code, 3) << campaign.out << campaign.err;
  EXPECT_THAT(campaign.out, HasSubstr("0 of 2 runs completed, 2 not measured"));
}

TEST(FmuLoop, AnFmuIsRefusedWithoutCommands) {
  write_fmu(2, "heading2", heading_description(2, "heading2"));
  expect_one_line(hil_bench(fmt::format("run {} --lockstep --no-commands {}",
                                        fmu_loop("fmu.toml", fmu_keys()), steered_by_autopilot)),
                  "is an FMU, whose code would be executed");
}

// A campaign over a parameter of the FMU: the same results with one thread, with two, and from two machines.
TEST(FmuLoop, ACampaignSweepsItsParameters) {
  write_fmu(3, "heading3", heading_description(3, "heading3"));
  static_cast<void>(fmu_loop("fmu.toml", fmu_keys()));
  const std::string campaign = own_folder() + "/campaign.toml";
  std::ofstream(campaign) << "title = \"craft\"\nruns = 2\nseed = 5\n[[variant]]\nname = \"FMU\"\n"
                             "scenario = \"fmu.toml\"\n[sweep]\n\"plant.parameters.gain\" = [1.0, 1.2, 1.4]\n"
                             "[[metric]]\nkind = \"distribution\"\nname = \"heading\"\n"
                             "quantity = \"attitude.heading\"\nat_s = 3.0\nrms_at_most_mrad = 20.0\n";
  const auto flies = [&](const std::string& options) {
    const Ended ended = hil_bench(fmt::format("campaign {} {} {}", campaign, steered_by_autopilot, options));
    EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  };
  std::vector<std::string> exported;
  const auto take = [&](const std::string& results) {
    const Ended all = hil_bench("campaign export " + results);
    EXPECT_EQ(all.code, 0) << all.err;
    exported.push_back(all.out);
  };
  const auto file = [](const std::string& name) { return own_folder() + "/" + name + ".sqlite"; };
  flies("--threads 1 --out " + file("one"));
  take(file("one"));
  flies("--threads 2 --out " + file("two"));
  take(file("two"));
  flies("--shard 0/2 --out " + file("shard0"));
  flies("--shard 1/2 --out " + file("shard1"));
  const Ended merged =
      hil_bench(fmt::format("campaign merge {} {} {}", file("all"), file("shard0"), file("shard1")));
  EXPECT_EQ(merged.code, 0) << merged.err;
  take(file("all"));
  EXPECT_THAT(exported[0], HasSubstr("plant.parameters.gain=1.4"));
  EXPECT_EQ(exported[0], exported[1]);
  EXPECT_EQ(exported[0], exported[2]);
}

}  // namespace
}  // namespace canhil::test
