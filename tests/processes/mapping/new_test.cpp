// `hil-bench new`: what it writes loads, and flies as far as it can.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string examples = SOURCE_DIR "/docs/examples/";

struct Device {
  const char* folder;
  const char* node;
};

void PrintTo(const Device& device, std::ostream* out) { *out << device.folder; }

class NewFiles : public testing::TestWithParam<Device> {
 protected:
  // A new file in a folder of its own, and the command that writes it.
  std::string file(const std::string& name) {
    const std::string folder = scratch(std::string("new_") + GetParam().folder);
    fs::create_directories(folder);
    fs::remove(folder + "/" + name);
    return folder + "/" + name;
  }
};

TEST_P(NewFiles, AreReadByTheBench) {
  const std::string dbc = fmt::format("{0}{1}/{1}.dbc", examples, GetParam().folder);
  const std::string mapping = file("mine.mapping.toml"), scenario = file("mine.toml");
  const Ended mapped =
      hil_bench(fmt::format("new mapping {} --dbc {} --device {}", mapping, dbc, GetParam().node));
  ASSERT_EQ(mapped.code, 0) << mapped.err;
  EXPECT_EQ(mapped.err, "") << "nothing is left to mend";
  const Ended checked = hil_bench("dbc check " + mapping);
  EXPECT_NE(checked.code, 2) << checked.err;
  const Ended written = hil_bench(fmt::format("new scenario {} --mapping {}", scenario, mapping));
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_EQ(written.err, "");
  const Ended again =
      hil_bench(fmt::format("new mapping {} --dbc {} --device {}", mapping, dbc, GetParam().node));
  expect_one_line(again, "exists already, expected a new file");
  expect_one_line(hil_bench(fmt::format("new scenario {} --mapping {}", scenario, mapping)),
                  "exists already");
}

INSTANTIATE_TEST_SUITE_P(Examples, NewFiles,
                         testing::Values(Device{"own_ecu", "ECU"}, Device{"car", "INS"}, Device{"auv", "Nav"},
                                         Device{"uav", "Nav"}, Device{"marine", "Navigator"}),
                         [](const auto& one) { return std::string(one.param.folder); });

TEST(New, AMappingHasWhatNamesAndUnitsTell) {
  const std::string mapping = scratch("told.mapping.toml");
  fs::remove(mapping);
  ASSERT_EQ(hil_bench(fmt::format("new mapping {} --dbc {}car/car.dbc --device INS", mapping, examples)).code,
            0);
  const std::string text = read(mapping);
  EXPECT_THAT(text, HasSubstr("\"WHL_Speeds.WHL_FrontLeft\" = \"wheels.front_left\""));
  EXPECT_THAT(text, HasSubstr("INS_Yaw = \"attitude.heading\""));
}

// A path is a TOML string, whatever characters it has.
TEST(New, APathMayHaveQuotes) {
  const std::string folder = scratch("quo\"ted"), in_shell = fmt::format("'{}'", folder);
  fs::create_directories(folder);
  fs::copy_file(examples + "car/car.dbc", folder + "/car.dbc", fs::copy_options::overwrite_existing);
  for (const char* name : {"/m.mapping.toml", "/m.toml"}) fs::remove(scratch("quoted") + name);
  fs::create_directories(scratch("quoted"));
  const std::string mapping = scratch("quoted") + "/m.mapping.toml", scenario = scratch("quoted") + "/m.toml";
  const Ended mapped =
      hil_bench(fmt::format("new mapping {} --dbc {}/car.dbc --device INS", mapping, in_shell));
  EXPECT_EQ(mapped.code, 0) << mapped.err;
  EXPECT_EQ(mapped.err, "") << "it is read again";
  EXPECT_EQ(hil_bench(fmt::format("new scenario {} --mapping {}", scenario, mapping)).err, "");
}

TEST(New, AScenarioOfAnEstimatorFlies) {
  const std::string scenario = scratch("wind_of_my_own.toml");
  fs::remove(scenario);
  ASSERT_EQ(hil_bench(fmt::format("new scenario {} --estimator wind", scenario)).code, 0);
  EXPECT_EQ(hil_bench(fmt::format("run {} --bus in-process", scenario)).code, 3)
      << "no timing in virtual time";
  expect_one_line(hil_bench(fmt::format("new scenario {} --estimator wind", scratch("none/x.toml"))), "none");
  expect_one_line(
      hil_bench(fmt::format("new scenario {} --estimator wond", scratch("x.toml"))),
      "--estimator 'wond': expected one of inflight_alignment, los_rate, transfer_alignment, wind");
  expect_one_line(hil_bench(fmt::format("new scenario {}", scratch("x.toml"))), "--mapping or --estimator");
}

TEST(New, ADeviceIsANodeOfTheDbc) {
  const std::string mapping = scratch("x.mapping.toml");
  expect_one_line(hil_bench(fmt::format("new mapping {} --dbc {}car/car.dbc --device IN", mapping, examples)),
                  "--device 'IN'");
  expect_one_line(hil_bench(fmt::format("new mapping {} --dbc no.dbc --device INS", mapping)), "no.dbc");
  EXPECT_FALSE(fs::exists(mapping));
}

}  // namespace
}  // namespace canhil::test
