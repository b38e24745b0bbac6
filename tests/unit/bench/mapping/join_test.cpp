// The mappings of several targets on one bus become one.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <string>
#include <vector>

#include "bench/mapping/mapping.hpp"

namespace canhil::mapping {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A DBC with a sensor message, which may have pages, and an answer.
std::string dbc(int answer_id, const std::string& more = "") {
  return fmt::format(R"(VERSION ""
NS_ :
BS_:
BU_: Sensor Device
BO_ 100 Imu: 8 Sensor
 SG_ Page M : 0|8@1+ (1,0) [0|255] "" Device
 SG_ GyroX : 8|16@1- (0.0001,0) [0|0] "rad/s" Device
BO_ {} Out: 8 Device
 SG_ Roll : 0|16@1- (0.001,0) [0|0] "rad" Sensor
{})",
                     answer_id, more);
}
constexpr const char* play_of_page = R"(dbc = "{}.dbc"
[[play]]
messages = ["Imu"]
every_ms = 10
[play.signals]
"Imu.Page" = {}
"Imu.GyroX" = "imu.rate.x"
[[hear]]
message = "Out"
answers = "Imu"
signals = {{ Roll = "attitude.roll" }}
)";
std::string mapping(const std::string& name, int page = 0) {
  return fmt::format(fmt::runtime(play_of_page), name, page);
}

using Files = std::map<std::string, std::string>;
Result<std::shared_ptr<const Mapping>> read(const Files& files) {
  const std::vector<std::string> names{"left.mapping.toml", "right.mapping.toml"};
  return read_mappings(names, [&](const std::string& file) -> Result<std::string> { return files.at(file); });
}
Files two(const std::string& right_dbc, const std::string& right) {
  return {{"left.mapping.toml", mapping("left")},
          {"left.dbc", dbc(200)},
          {"right.mapping.toml", right},
          {"right.dbc", right_dbc}};
}
std::vector<std::string> names(const Mapping& of) {
  std::vector<std::string> all;
  for (const MessageInfo& one : of.messages) all.emplace_back(one.name);
  return all;
}

TEST(Join, WhatIsEqualIsPlayedOnce) {
  const auto read_two = read(two(dbc(201), mapping("right")));
  ASSERT_TRUE(read_two) << read_two.error().message;
  const Mapping& all = **read_two;
  EXPECT_THAT(names(all), ElementsAre("Imu", "Out", "right.Out"));
  ASSERT_EQ(all.plays.size(), 1U);
  ASSERT_EQ(all.hears.size(), 2U);
  EXPECT_EQ(all.hears[1].answers, std::size_t{0});
  ASSERT_EQ(all.targets.size(), 2U);
  EXPECT_EQ(all.targets[1].closing, std::vector<std::string_view>{"right.Out"});
  EXPECT_EQ(all.targets[1].estimator->name, "right");
  EXPECT_EQ(all.estimator_of(all.messages[1]), "left");
  EXPECT_EQ(all.estimator_of(all.messages[2]), "right");
  EXPECT_EQ(all.estimator_of(all.messages[0]), "");
}

TEST(Join, EachPageMayBeOfAnotherTarget) {
  const auto read_two = read(two(dbc(201), mapping("right", 1)));
  ASSERT_TRUE(read_two) << read_two.error().message;
  ASSERT_EQ((*read_two)->plays.size(), 2U);
  EXPECT_EQ((*read_two)->plays[1].name, "Imu Page=1");
  EXPECT_EQ((*read_two)->hears[1].answers, std::size_t{1});
}

// On a bus of real devices two nodes cannot share an id. A frame of such an id counts for both.
TEST(Join, AnIdOfTwoTargetsIsHeardForBoth) {
  const auto read_two = read(two(dbc(200), mapping("right")));
  ASSERT_TRUE(read_two) << read_two.error().message;
  const Places places(**read_two);
  EXPECT_THAT(places.hears(Frame{.id = 200, .size = 8}), ElementsAre(0U, 1U));
  EXPECT_THAT(places.hears(Frame{.id = 100, .size = 8}), ElementsAre());
}

TEST(Join, WhatOneSendsTheBenchDoesNotSend) {
  const std::string other = R"(dbc = "right.dbc"
[[play]]
messages = ["Out"]
every_ms = 10
[play.signals]
"Out.Roll" = "master_ins.roll"
[[hear]]
message = "Imu"
)";
  const auto read_two = read(two(dbc(200), other));
  ASSERT_FALSE(read_two);
  EXPECT_THAT(read_two.error().message,
              HasSubstr("right.mapping.toml: Out is sent by a target and by the bench"));
}

TEST(Join, OtherValuesAreRefused) {
  for (const auto& [one, other] : {std::pair<std::string, std::string>("\"imu.rate.x\"", "\"-imu.rate.x\""),
                                   {"every_ms = 10", "every_ms = 20"}}) {
    std::string right = mapping("right");
    right.replace(right.find(one), one.size(), other);
    const auto read_two = read(two(dbc(201), right));
    ASSERT_FALSE(read_two) << other;
    EXPECT_THAT(read_two.error().message, HasSubstr("expected the same play in both mappings"));
  }
}

// A DBC may describe what a transport protocol carries in several frames.
TEST(ReadMapping, AMessageThatNoFrameHasIsRefused) {
  const auto read_two =
      read(two(dbc(201, "BO_ 2566835710 Fix: 43 Sensor\n SG_ Lat : 56|64@1- (1,0) [0|0] \"\" Device\n"),
               mapping("right") + "[[hear]]\nmessage = \"Fix\"\n"));
  ASSERT_FALSE(read_two);
  EXPECT_THAT(
      read_two.error().message,
      HasSubstr("'hear[2].message': Fix has 43 bytes, which no frame has, expected a message of one frame"));
}

}  // namespace
}  // namespace canhil::mapping
