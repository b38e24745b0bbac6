// The autopilot of docs/examples steers an FMU.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/processes/hil/program.hpp"
#include "tests/unit/bench/plant/heading_fmu.hpp"

namespace canhil::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string example = SOURCE_DIR "/docs/examples/autopilot/";
const std::string steered_by =
    "--target '/usr/bin/python3 " SOURCE_DIR "/docs/examples/autopilot/autopilot.py'";

// The scenario of the example without the offset of the actuator, which the FMU does not have. `plant`: the
// keys of the table [plant]; the default is the plant that is built in.
std::string loop(const std::string& name, const std::string& plant = "") {
  std::string text = read(example + "autopilot.toml");
  const auto change = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  change("actuator_offset_deg = 4\n", "");
  change("autopilot.mapping.toml", example + "autopilot.mapping.toml");
  if (!plant.empty()) {
    const std::size_t from = text.find("kind = \"steered_heading\""),
                      to = text.find("[plant.commands.rudder]");
    text.replace(from, to - from, plant);
    change("\"plant.rudder\"", "\"plant.rudder_angle\"");
  }
  std::ofstream(own_folder() + "/" + name) << text;
  return own_folder() + "/" + name;
}

std::string fmu_keys(const std::string& more = "") {
  constexpr double deg = 3.14159265358979323846 / 180;
  return fmt::format(
      "kind = \"fmu\"\nfile = \"{}/model.fmu\"\nstep_ms = 10\n{}[plant.parameters]\nheading = {}\nspeed = 8\n"
      "time_constant = 0.4\ngain = 1.2\nlag = 0.05\nrate_limit = {}\nstop = {}\ngust = {}\ngust_from = 12\n"
      "gust_to = 15\n",
      own_folder(), more, 350 * deg, 120 * deg, 30 * deg, 60 * deg);
}

std::vector<double> headings_of(const std::string& csv) {
  std::vector<double> all;
  std::istringstream lines(read(csv));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("plant,plant.attitude.heading,rad,,");
    if (at != std::string::npos) all.push_back(std::stod(line.substr(at + 34)));
  }
  return all;
}

class FmuLoops : public testing::TestWithParam<int> {};

TEST_P(FmuLoops, MovesLikeThePlantThatIsBuiltIn) {
  const std::string model = fmt::format("heading{}", GetParam());
  write_fmu(GetParam(), model, heading_description(GetParam(), model));
  std::vector<std::vector<double>> flown;
  for (const std::string& scenario : {loop("built_in.toml"), loop("fmu.toml", fmu_keys()),
                                      loop("here.toml", fmu_keys("in_process = true\n"))}) {
    const std::string csv = scratch("flown.csv");
    const Ended ended = hil_bench(fmt::format("run {} --lockstep {} --csv {}", scenario, steered_by, csv));
    ASSERT_EQ(ended.code, 3) << ended.out << ended.err;
    flown.push_back(headings_of(csv));
  }
  ASSERT_EQ(flown[0].size(), 3001U);
  ASSERT_EQ(flown[1].size(), 3001U);
  for (std::size_t i = 0; i < flown[0].size(); ++i) ASSERT_NEAR(flown[0][i], flown[1][i], 1e-10) << i;
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
  const Ended ended = hil_bench(fmt::format("run {} --lockstep {}", loop("fails.toml", keys), steered_by));
  EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("not measured: "));
  EXPECT_THAT(ended.out, HasSubstr("model.fmu"));
}

TEST(FmuLoop, AnFmuIsRefusedWithoutCommands) {
  write_fmu(2, "heading2", heading_description(2, "heading2"));
  expect_one_line(
      hil_bench(fmt::format("run {} --lockstep --no-commands {}", loop("fmu.toml", fmu_keys()), steered_by)),
      "is an FMU, whose code would be executed");
}

// A campaign over a parameter of the FMU: the same results with one thread, with two, and from two machines.
TEST(FmuLoop, ACampaignSweepsItsParameters) {
  write_fmu(3, "heading3", heading_description(3, "heading3"));
  static_cast<void>(loop("fmu.toml", fmu_keys()));
  const std::string campaign = own_folder() + "/campaign.toml";
  std::ofstream(campaign) << "title = \"craft\"\nruns = 2\nseed = 5\n[[variant]]\nname = \"FMU\"\n"
                             "scenario = \"fmu.toml\"\n[sweep]\n\"plant.parameters.gain\" = [1.0, 1.2, 1.4]\n"
                             "[[metric]]\nkind = \"distribution\"\nname = \"heading\"\n"
                             "quantity = \"attitude.heading\"\nat_s = 3.0\nrms_at_most_mrad = 20.0\n";
  const auto flies = [&](const std::string& options) {
    const Ended ended = hil_bench(fmt::format("campaign {} {} {}", campaign, steered_by, options));
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
