// What a mapping defines itself: sensors, quantities and flags.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <string>

#include "bench/mapping/mapping.hpp"
#include "bench/mapping/reading.hpp"
#include "bench/mapping/receiver.hpp"
#include "bench/sensors/generic.hpp"
#include "bench/sensors/registry.hpp"
#include "tests/unit/bench/mapping/read_mapped.hpp"

namespace canhil::mapping {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* dbc = R"(VERSION ""
NS_ :
BS_:
BU_: Sensor Device
BO_ 100 In: 8 Sensor
 SG_ Angle : 0|16@1- (0.01,0) [0|0] "deg" Device
 SG_ Share : 16|16@1+ (0.001,0) [0|0] "" Device
BO_ 200 Out: 8 Device
 SG_ Turn : 0|16@1- (0.0001,0) [0|0] "1/m" Sensor
 SG_ Tank : 16|16@1+ (1,0) [0|0] "Pa" Sensor
 SG_ Word : 32|8@1+ (1,0) [0|0] "" Sensor
 SG_ Mode : 40|4@1- (1,0) [0|0] "" Sensor
VAL_ 200 Mode 0 "INIT" 3 "GOOD" -1 "BAD" ;
)";
constexpr const char* mapping = R"(dbc = "ecu.dbc"
signs = ["b_out"]
[sensors]
wheel = { angle = { unit = "rad", turns = true }, share = "1" }
[quantities]
curvature = { unit = "1", truth = "rate.z / ground_speed" }
"tank.pressure" = { unit = "Pa" }
[[play]]
messages = ["In"]
every_ms = 20
[play.signals]
"In.Angle" = "wheel.angle"
"In.Share" = "wheel.share"
[[hear]]
message = "Out"
answers = "In"
signals = { Turn = "curvature", Tank = "tank.pressure" }
[hear.flags]
Word = { a_out = { bit = 0 }, b_out = { bit = 5 }, seven = 7 }
Mode = { good = "GOOD", bad = "BAD" }
)";

Result<std::shared_ptr<const Mapping>> read(const std::string& text, const std::string& of_dbc = dbc) {
  const std::map<std::string, std::string> files{{"ecu.mapping.toml", text}, {"ecu.dbc", of_dbc}};
  return read_mapping("ecu.mapping.toml",
                      [&](const std::string& file) -> Result<std::string> { return files.at(file); });
}
std::string instead(const std::string& line, const std::string& other) {
  std::string text = mapping;
  const std::size_t at = text.find(line);
  EXPECT_NE(at, std::string::npos) << line;
  return text.replace(at, line.size(), other);
}
std::string error(const std::string& line, const std::string& other) {
  const auto wrong = read(instead(line, other));
  return wrong ? "" : wrong.error().message;
}

TEST(Own, SensorHasTheValuesThatTheMappingDeclares) {
  const auto all = read(mapping);
  ASSERT_TRUE(all) << all.error().message;
  ASSERT_EQ((*all)->sensors.size(), 1U);
  const sensors::Kind& wheel = *(*all)->sensors.front();
  EXPECT_EQ(&wheel, &sensors::declared("wheel", {{.name = "angle", .si = "rad", .turns = true},
                                                 {.name = "share", .si = ""}}));
  EXPECT_EQ(wheel.key, "wheel");
  const Play& play = (*all)->plays.front();
  ASSERT_EQ(play.messages.front().sources.size(), 2U);
  EXPECT_EQ(play.sensor, &wheel);
  EXPECT_NEAR(play.messages.front().sources[0].factor, 180 / 3.14159265358979, 1e-12);
  EXPECT_EQ(play.messages.front().sources[1].factor, 1);
}

TEST(Own, QuantityHasItsTruth) {
  const auto all = read(mapping);
  ASSERT_TRUE(all) << all.error().message;
  const MappedTarget& target = (*all)->targets.front();
  ASSERT_EQ(target.own.size(), 2U);
  EXPECT_TRUE(target.own[0].has_truth());
  EXPECT_FALSE(target.own[1].has_truth());
  const world::FlightRecord flight({.start = {},
                                    .motion = world::SPath{.speed = 20,
                                                           .heading_amplitude = 0.5,
                                                           .heading_period = 10,
                                                           .pitch_period = 1,
                                                           .roll_period = 1,
                                                           .depth = {}}},
                                   5'000'000, 10'000);
  const world::Truth at = flight.at(1'234'000);
  EXPECT_DOUBLE_EQ(truth_of(target.own[0], {.flight = flight, .duration_us = 5'000'000}, 1'234'000).value(),
                   at.omega_ib_b.z() / std::hypot(at.v_eb_n.x(), at.v_eb_n.y()));
  EXPECT_EQ(truth_of(target.own[1], {.flight = flight, .duration_us = 5'000'000}, 1'234'000), std::nullopt);
  // Campaigns keep the quantities of the bench only.
  EXPECT_TRUE(target.layout->kept.empty());
}

TEST(Own, FlagsAreBitsOrValuesOfASignal) {
  const auto all = read(mapping);
  ASSERT_TRUE(all) << all.error().message;
  const auto set = [&](const std::string& name, std::uint64_t raw) {
    const auto& flags = (*all)->hears.front().flags;
    return std::ranges::find(flags, name, &ReportedFlag::name)->is_set(raw);
  };
  EXPECT_TRUE(set("a_out", 0x21) && set("b_out", 0x21) && !set("seven", 0x21));
  EXPECT_TRUE(set("seven", 7) && !set("b_out", 7));
  EXPECT_TRUE(set("good", 3) && !set("good", 2) && set("bad", 0xF) && !set("bad", 3));
  EXPECT_THAT((*all)->targets.front().plain_marks, ElementsAre("Out", "a_out", "seven", "bad", "good"));
  std::vector<std::string> marks;
  for (const auto& mark : (*all)->estimators.front()->marks(checks::Observations((*all)->messages)))
    marks.emplace_back(mark.name);
  EXPECT_THAT(marks, ElementsAre("answers", "Out", "a_out", "b_out", "seven", "bad", "good"));
}

TEST(Own, ErrorsSayWhatIsExpected) {
  EXPECT_THAT(error("share = \"1\"", "share = \"percent\""), HasSubstr("'percent' is not the SI unit"));
  EXPECT_THAT(error("share = \"1\"", "Share = \"1\""), HasSubstr("is no name of a value"));
  EXPECT_THAT(error("share = \"1\"", "share = { unit = \"m\", turns = true }"), HasSubstr("is for angles"));
  EXPECT_THAT(error("wheel = { angle", "gps = { angle"), HasSubstr("is a kind"));
  EXPECT_THAT(error("rate.z / ground", "rate.q / ground"), HasSubstr("'rate.q' is no true value"));
  EXPECT_THAT(error("curvature = {", "velocity.north = {"), HasSubstr("velocity"));
  EXPECT_THAT(error("\"tank.pressure\" = {", "\"course\" = {"), HasSubstr("is a quantity of the bench"));
  EXPECT_THAT(error("\"tank.pressure\" = {", "\"Tank\" = {"), HasSubstr("is no name of a quantity"));
  EXPECT_THAT(error("Tank = \"tank.pressure\"", "Tank = \"curvature\""), HasSubstr("Pa"));
  EXPECT_THAT(error("bit = 5", "bit = 8"), HasSubstr("Word has 8 bits"));
  EXPECT_THAT(error("seven = 7", "seven = 256"), HasSubstr("does not fit into its 8 bits"));
  EXPECT_THAT(error("\"GOOD\"", "\"GOD\""), HasSubstr("expected 'GOOD'"));
  EXPECT_THAT(error("bad = \"BAD\"", "seven = \"BAD\""), HasSubstr("seven is reported twice"));
  EXPECT_THAT(error("Word = {", "Wort = {"), HasSubstr("has no signal 'Wort'"));
}

// The parts are Euler's: C_bn turns about z, then y, then x. The numbers are computed by hand for the angles
// 90, 0 and 0 deg, and for the half turn about the diagonal of x and y.
TEST(Own, QuaternionGivesTheThreeAngles) {
  const std::string text = R"(VERSION ""
NS_ :
BS_:
BU_: Sensor Device
BO_ 100 In: 8 Sensor
 SG_ Angle : 0|16@1- (0.01,0) [0|0] "deg" Device
BO_ 200 Out: 8 Device
 SG_ W : 0|16@1- (0.0001,0) [0|0] "" Sensor
 SG_ X : 16|16@1- (0.0001,0) [0|0] "" Sensor
 SG_ Y : 32|16@1- (0.0001,0) [0|0] "" Sensor
 SG_ Z : 48|16@1- (0.0001,0) [0|0] "" Sensor
)";
  const std::string of = R"(dbc = "ecu.dbc"
[[play]]
messages = ["In"]
every_ms = 20
[play.signals]
"In.Angle" = "gps.latitude"
[[hear]]
message = "Out"
answers = "In"
signals = { W = "attitude.quaternion.w", X = "attitude.quaternion.x", Y = "attitude.quaternion.y", Z = "-attitude.quaternion.z" }
invalid = { W = 0x8000 }
)";
  const auto all = read(of, text);
  ASSERT_TRUE(all) << all.error().message;
  const Hear& hear = (*all)->hears.front();
  const auto angles = [&](std::array<std::int16_t, 4> parts) {
    std::array<std::uint8_t, 8> bytes{};
    for (std::size_t i = 0; i < 8; ++i)
      bytes[i] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(parts[i / 2]) >> (8 * (i % 2)));
    std::vector<double> values;
    std::map<std::string_view, double> told;
    mapping::read(hear, bytes, values, [&](const ReportedSignal& signal, double value, bool /*invalid*/) {
      told[signal.quantity->quantity->name] = value / (3.14159265358979 / 180);
    });
    return std::vector{told["attitude.roll"], told["attitude.pitch"], told["attitude.heading"]};
  };
  const auto near = [](double value) { return testing::DoubleNear(value, 0.02); };
  EXPECT_THAT(angles({7071, 0, 0, -7071}), ElementsAre(near(0), near(0), near(90)));
  EXPECT_THAT(angles({7071, 7071, 0, 0}), ElementsAre(near(90), near(0), near(0)));
  EXPECT_THAT(angles({7071, 0, 7071, 0}), ElementsAre(testing::_, near(90), testing::_));
  EXPECT_THAT(angles({9000, 0, 0, -9000}), ElementsAre(near(0), near(0), near(90))) << "it is normalised";
  EXPECT_TRUE(std::isnan(angles({-32768, 0, 0, 0})[0])) << "invalid";
  EXPECT_TRUE(std::isnan(angles({0, 0, 0, 0})[2])) << "no rotation";
  const auto without = [&](const std::string& line, const std::string& other) {
    std::string changed = of;
    changed.replace(changed.find(line), line.size(), other);
    const auto wrong = read(changed, text);
    return wrong ? "" : wrong.error().message;
  };
  EXPECT_THAT(without(", Y = \"attitude.quaternion.y\"", ""), HasSubstr("without attitude.quaternion.y"));
  EXPECT_THAT(without("\"attitude.quaternion.y\"", "\"attitude.quaternion.x\""), HasSubstr("each part once"));
  EXPECT_THAT(without("Y = \"attitude.quaternion.y\"", "Y = \"attitude.roll\""), HasSubstr("Y"));
}

// A message of 20 bytes of NMEA 2000 is sent in three frames and received from three frames.
TEST(Own, FastPacketsAreSentAndReceived) {
  const std::string text = R"(VERSION ""
NS_ :
BS_:
BU_: Sensor Device
BO_ 2583167266 In: 20 Sensor
 SG_ Latitude : 56|64@1- (1E-16,0) [-90|90] "deg" Device
BO_ 2583167268 Out: 20 Device
 SG_ Height : 120|32@1- (0.01,0) [0|0] "m" Sensor
)";
  const std::string of = R"(dbc = "ecu.dbc"
[[play]]
messages = ["In"]
every_ms = 20
[play.signals]
"In.Latitude" = "gps.latitude"
[[hear]]
message = "Out"
any_source = true
signals = { Height = "position.height" }
)";
  const auto all = read(of, text);
  ASSERT_TRUE(all) << all.error().message;
  EXPECT_FALSE((*all)->messages.front().fd);
  EXPECT_EQ((*all)->plays.front().messages.front().of.frames(), 3U);
  const Hear& hear = (*all)->hears.front();
  Receiver receiver;
  std::vector<std::uint8_t> bytes(20);
  bytes[15] = 0xD2;  // 1234 = 0x4D2
  bytes[16] = 0x04;
  std::size_t whole = 0;
  for (const auto& part : transport::split_fast_packet(bytes, 6)) {
    Frame frame{.id = hear.of.message->id, .size = 8, .extended = true};
    std::ranges::copy(part, frame.data.begin());
    const auto taken = receiver.take(hear.of, frame);
    if (taken.outcome != Receiver::Outcome::whole) continue;
    ++whole;
    std::vector<double> values;
    mapping::read(hear, taken.bytes, values,
                  [](const ReportedSignal&, double value, bool) { EXPECT_DOUBLE_EQ(value, 12.34); });
  }
  EXPECT_EQ(whole, 1U);
  EXPECT_EQ(receiver.take(hear.of, {.id = hear.of.message->id, .size = 7, .extended = true}).outcome,
            Receiver::Outcome::wrong_size);
}

// A message of 20 bytes of J1939 is heard from an announcement and three packets; other groups do not matter.
TEST(Own, MessagesOfTheTransportProtocolOfJ1939AreHeard) {
  const std::string text = R"(VERSION ""
NS_ :
BS_:
BU_: Sensor Device
BO_ 2566834709 In: 8 Sensor
 SG_ Latitude : 0|64@1- (1E-16,0) [-90|90] "deg" Device
BO_ 2566843394 Out: 20 Device
 SG_ Height : 120|32@1- (0.01,0) [0|0] "m" Sensor
BA_DEF_ "ProtocolType" STRING ;
BA_ "ProtocolType" "J1939";
)";
  const std::string of = R"(dbc = "ecu.dbc"
[[play]]
messages = ["In"]
every_ms = 20
[play.signals]
"In.Latitude" = "gps.latitude"
[[hear]]
message = "Out"
signals = { Height = "position.height" }
)";
  const auto all = read(of, text);
  ASSERT_TRUE(all) << all.error().message;
  const Hear& hear = (*all)->hears.front();
  EXPECT_EQ(hear.of.frames(), 4U);
  const Places places(**all);
  std::vector<std::uint8_t> bytes(20);
  bytes[15] = 0xD2;  // 1234 = 0x4D2
  bytes[16] = 0x04;
  constexpr std::uint32_t other_group = 0x18FECA00;
  Receiver receiver;
  const auto wholes_of = [&](const std::vector<Frame>& frames) {
    std::size_t wholes = 0;
    for (const Frame& frame : frames) {
      EXPECT_EQ(places(frame), hear.of.index);
      EXPECT_THAT(places.hears(frame), testing::ElementsAre(0U));
      const auto taken = receiver.take(hear.of, frame);
      EXPECT_EQ(taken.lost, 0U);
      if (taken.outcome != Receiver::Outcome::whole) continue;
      ++wholes;
      std::vector<double> values;
      mapping::read(hear, taken.bytes, values,
                    [](const ReportedSignal&, double value, bool) { EXPECT_DOUBLE_EQ(value, 12.34); });
    }
    return wholes;
  };
  const std::uint32_t id = hear.of.message->id, source = id & 0xFFU;
  EXPECT_EQ(wholes_of(transport::split_j1939(bytes, other_group | source)), 0U);
  EXPECT_EQ(wholes_of(transport::split_j1939(bytes, id)), 1U);
  const Frame of_another = transport::split_j1939(bytes, id ^ 1U).front();
  EXPECT_EQ(places(of_another), MessagePlaces::nowhere);

  std::string played = of;
  played.replace(played.find("\"In\""), 4, "\"Out\"");
  const auto refused = read(played, text);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("plays nothing by the transport protocol of J1939"));
}

constexpr const char* scenario = R"(title = "a"
duration_s = 2
seed = 1
[target]
mapping = "ecu.mapping.toml"
[truth]
latitude_deg = 0
longitude_deg = 0
height_m = 0
trajectory = "rest"
heading_deg = 0
[[sensor]]
name = "wheel"
kind = "generic"
period_ms = 20
[sensor.values.angle]
truth = "t"
[sensor.values.share]
truth = "0.5"
noise = 0.1
[[check]]
kind = "protection"
)";

TEST(Own, ScenarioSaysWhatTheSensorMeasures) {
  const auto all = read_mapped(scenario, mapping, dbc);
  ASSERT_TRUE(all) << all.error().message;
  const auto* settings = all->nodes.front().own<sensors::GenericSettings>();
  ASSERT_NE(settings, nullptr);
  ASSERT_EQ(settings->values.size(), 2U);
  EXPECT_EQ(settings->values[1].noise, 0.1);

  const auto wrong = [&](const std::string& line, const std::string& other) {
    std::string text = scenario;
    text.replace(text.find(line), line.size(), other);
    const auto one = read_mapped(text, mapping, dbc);
    return one ? "" : one.error().message;
  };
  EXPECT_THAT(wrong("name = \"wheel\"", "name = \"weel\""),
              HasSubstr("'weel' is no generic sensor of the mapping"));
  EXPECT_THAT(wrong("[sensor.values.share]\ntruth = \"0.5\"\nnoise = 0.1\n", ""), HasSubstr("share"));
  EXPECT_THAT(wrong("\"0.5\"", "\"0.5 *\""), HasSubstr("is no expression"));
  EXPECT_THAT(wrong("noise = 0.1", "noisy = 0.1"), HasSubstr("noisy"));
  EXPECT_THAT(wrong("noise = 0.1", "lowest = 2\nhighest = 1"), HasSubstr("is above highest"));
  EXPECT_THAT(wrong("[[sensor]]\nname = \"wheel\"\nkind = \"generic\"", "[generic]"),
              HasSubstr("is no table"));
}

}  // namespace
}  // namespace canhil::mapping
