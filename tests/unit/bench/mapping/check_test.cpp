// What `hil-bench dbc check` says of the values that a flight plays.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "bench/drive/flight.hpp"
#include "bench/mapping/check.hpp"
#include "tests/unit/bench/mapping/read_mapped.hpp"

namespace canhil::mapping {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* check_dbc = R"(VERSION ""
NS_ :
BS_:
BU_: Sensor Device
BO_ 100 In: 8 Sensor
 SG_ Angle : 0|16@1- (0.01,0) [-180|180] "deg" Device
 SG_ Coarse : 16|8@1- (2,0) [-180|180] "deg" Device
 SG_ Narrow : 24|8@1+ (0.125,0) [0|25] "m/s" Device
 SG_ Wide : 32|16@1+ (0.0055,0) [0|359.995] "deg" Device
BO_ 200 Out: 2 Device
 SG_ Roll : 0|16@1- (0.01,0) [0|0] "deg" Sensor
)";
constexpr const char* check_mapping = R"(dbc = "ecu.dbc"
[sensors]
gyro = { roll = "rad", bent = "rad", speed = "m/s", course = { unit = "rad", turns = true } }
[[play]]
messages = ["In"]
every_ms = 10
[play.signals]
"In.Angle" = "gyro.roll"
"In.Coarse" = "gyro.bent"
"In.Narrow" = "gyro.speed"
"In.Wide" = "gyro.course"
[[hear]]
message = "Out"
answers = "In"
signals = { Roll = "attitude.roll" }
)";

scenario::Scenario flown_at(double speed_mps) {
  auto read = read_mapped(fmt::format(R"toml(title = "t"
duration_s = 20.0
seed = 1
[target]
mapping = "ecu.mapping.toml"
[truth]
latitude_deg = 48.0
longitude_deg = 11.0
height_m = 500.0
trajectory = "s_path"
speed_mps = {}
heading_deg = 0
heading_amplitude_deg = 40
turn_period_s = 10.0
[[sensor]]
name = "gyro"
kind = "generic"
period_ms = 10
[sensor.values.roll]
truth = "0.2 * sin(t)"
noise = 0.01
bias_sigma = 0.2
random_walk = 0.02
[sensor.values.bent]
truth = "0.5 * sin(t)"
noise = 0.01
[sensor.values.speed]
truth = "ground_speed"
[sensor.values.course]
truth = "attitude.heading"
noise = 0.001
[[check]]
kind = "error"
quantity = "attitude.roll"
below_deg = 1
)toml",
                                      speed_mps),
                          check_mapping, check_dbc);
  EXPECT_TRUE(read) << read.error().message;
  return std::move(*read);
}

FlownValues flown_values_of(const scenario::Scenario& scenario) {
  const auto truth = drive::make_truth(scenario);
  auto one = drive::make_flight(scenario, *truth, 0), other = drive::make_flight(scenario, *truth, 1);
  return flown_values(dynamic_cast<const Mapping&>(*scenario.binding),
                      drive::run_of(scenario, *truth, one->per_run_truth, 0),
                      drive::run_of(scenario, *truth, other->per_run_truth, 1));
}

std::vector<std::string> warnings(const scenario::Scenario& scenario) {
  const auto& mapping = dynamic_cast<const Mapping&>(*scenario.binding);
  std::vector<std::string> all;
  for (const Remark& one : remarks_on(mapping, flown_values_of(scenario))) {
    if (one.grade == Remark::Grade::warning)
      all.push_back(fmt::format("{} {}: {}", one.rule, one.subject, one.what));
  }
  return all;
}

// A step of 2 deg has a rounding noise of 0.577 deg, more than a quarter of 0.573 deg.
TEST(CheckWithAScenario, NamesCoarseSteps) {
  EXPECT_THAT(warnings(flown_at(20)), ElementsAre(HasSubstr("coarse In.Coarse: its step of 2 deg")));
}

TEST(CheckWithAScenario, NamesValuesThatDoNotFit) {
  EXPECT_THAT(
      warnings(flown_at(40)),
      ElementsAre(HasSubstr("coarse In.Coarse"),
                  HasSubstr("clipped In.Narrow: holds 0 to 25 m/s; the flight's values are 40 to 40")));
}

TEST(CheckWithAScenario, SaysNothingOfValuesWithoutOne) {
  const scenario::Scenario scenario = flown_at(40);
  std::vector<std::string> rules;
  for (const Remark& one : remarks_on(dynamic_cast<const Mapping&>(*scenario.binding))) {
    if (one.rule == "coarse" || one.rule == "clipped") rules.push_back(one.rule);
  }
  EXPECT_THAT(rules, IsEmpty());
}

// The noise is that of the sensor: neither the bias of a run nor the random walk belongs to it, and the
// heading passes 0 deg.
TEST(CheckWithAScenario, MeasuresWhiteNoise) {
  const scenario::Scenario scenario = flown_at(20);
  std::map<std::string, PlayedValues> by_signal;
  for (const auto& [source, values] : flown_values_of(scenario)) by_signal[source->signal->name] = values;
  constexpr double degrees = 57.29578;  // the estimate of 2000 samples has a sigma of 2 %
  EXPECT_NEAR(by_signal["Angle"].noise, 0.01 * degrees, 0.06 * 0.01 * degrees);
  EXPECT_NEAR(by_signal["Wide"].noise, 0.001 * degrees, 0.06 * 0.001 * degrees);
  EXPECT_EQ(by_signal["Narrow"].noise, 0);
}

}  // namespace
}  // namespace canhil::mapping
