// The table [plant]: what steers it, what moves, and one line for each error.
#include "bench/plant/setup.hpp"

#include <gmock/gmock.h>

#include "bench/world/units.hpp"
#include "tests/unit/bench/plant/closed_loop.hpp"

namespace canhil::plant {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using world::units::deg;

std::string with(std::string_view from, std::string_view to) {
  std::string text(closed_loop);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}
const Setup& setup_of(const Result<scenario::Scenario>& scenario) {
  static const Setup none;
  if (!scenario) ADD_FAILURE() << scenario.error().message;
  return scenario ? *scenario->plant.setup : none;
}
std::string complaint(std::string_view from, std::string_view to) {
  const auto scenario = read_loop(with(from, to));
  return scenario ? "no error" : scenario.error().message;
}

// An input takes the quantity INPUT.command, if the mapping has it.
TEST(PlantSetup, AnInputTakesItsCommand) {
  const auto scenario = read_loop();
  const auto& setup = setup_of(scenario);
  ASSERT_EQ(setup.commands.size(), 1U);
  EXPECT_EQ(setup.commands[0].from, "rudder.command");
  EXPECT_EQ(setup.commands[0].delay_us, 0);
  EXPECT_FALSE(setup.commands[0].timeout_us);
  EXPECT_THAT(setup.start, ElementsAre(0));
  EXPECT_TRUE(scenario->plant.moves_the_carrier);
  EXPECT_TRUE(scenario->closes_the_loop());
  EXPECT_THAT(scenario->plant.steered, ElementsAre("rudder"));
}

TEST(PlantSetup, ACommandHasADelayATimeoutAndAStart) {
  const auto scenario = read_loop(with("[master_ins]",
                                       "[plant.commands.rudder]\nstart_deg = 5\ndelay_ms = 30\n"
                                       "timeout_ms = 200\nafter_timeout_deg = -2\n[master_ins]"));
  const auto& setup = setup_of(scenario);
  ASSERT_EQ(setup.commands.size(), 1U);
  EXPECT_EQ(setup.commands[0].delay_us, 30'000);
  EXPECT_EQ(setup.commands[0].timeout_us, 200'000);
  EXPECT_DOUBLE_EQ(setup.commands[0].after_timeout.value(), -2 * deg);
  EXPECT_DOUBLE_EQ(setup.start[0], 5 * deg);
}

// A flag is a command too: 1 if it is set. A plain number fits to any unit.
TEST(PlantSetup, AFlagMaySteer) {
  const auto scenario =
      read_loop(with("[master_ins]", "[plant.commands.rudder]\nfrom = \"engaged\"\n[master_ins]"));
  EXPECT_EQ(setup_of(scenario).commands.at(0).from, "engaged");
}

TEST(PlantSetup, TheMotionMayComeFromExpressions) {
  const auto scenario = read_loop(
      with("[master_ins]", "[plant.motion]\n\"attitude.roll\" = \"0.1 * plant.rudder\"\n[master_ins]"));
  const auto& setup = setup_of(scenario);
  EXPECT_TRUE(setup.motion[0]) << "roll";
  EXPECT_FALSE(setup.motion[1]) << "pitch";
  EXPECT_TRUE(setup.motion[2]) << "heading, from the output of this name";
}

TEST(PlantSetup, WhatIsWrongIsOneLine) {
  EXPECT_THAT(complaint("kind = \"steered_heading\"", "kind = \"submarine\""), HasSubstr("key 'plant.kind'"));
  EXPECT_THAT(
      complaint("trajectory = \"plant\"", "trajectory = \"rest\"\nheading_deg = 0"),
      HasSubstr("key 'truth.trajectory': is 'rest', but the plant moves the carrier, expected 'plant'"));
  EXPECT_THAT(complaint("[master_ins]", "[plant.commands.rudder]\nfrom = \"heading\"\n[master_ins]"),
              HasSubstr("key 'plant.commands.rudder.from': 'heading' is unknown, expected one of: "
                        "rudder.command, flow.command, engaged"));
  EXPECT_THAT(complaint("[master_ins]", "[plant.commands.rudder]\nfrom = \"flow.command\"\n[master_ins]"),
              HasSubstr("key 'plant.commands.rudder.from': is in m/s, expected a command in rad"));
  EXPECT_THAT(complaint("[master_ins]", "[plant.commands.ruder]\n[master_ins]"),
              HasSubstr("key 'plant.commands.ruder': is no input of the plant"));
  EXPECT_THAT(complaint("[master_ins]", "[plant.commands.rudder]\ntimeout_ms = 10\n[master_ins]"),
              HasSubstr("key 'plant.commands.rudder.after_timeout_deg': is missing"));
  EXPECT_THAT(complaint("[master_ins]", "[plant.motion]\n\"attitude.roll\" = \"rate.z\"\n[master_ins]"),
              HasSubstr("uses rate.z, which follows from the motion"));
  EXPECT_THAT(complaint("[master_ins]", "[plant.motion]\n\"attitude.roll\" = \"plant.depth\"\n[master_ins]"),
              HasSubstr("uses 'plant.depth', which is no output of the plant"));
  EXPECT_THAT(complaint("speed_mps = 10", "speed_mps = 10\nwings = 2"),
              HasSubstr("key 'plant.wings': is unknown"));
  EXPECT_THAT(
      complaint("[[check]]",
                "[[check]]\nkind = \"response\"\nquantity = \"plant.depth\"\nstatistic = \"overshoot\"\n"
                "setpoint = 1\nbelow = 1\n[[check]]"),
      HasSubstr("'plant.depth'"));
}

// A plant that nobody steers would only coast, and a loop that is not closed would pass.
TEST(PlantSetup, AnInputWithoutACommandIsRefusedUnlessItIsConstant) {
  const std::string mapping = [] {
    std::string text(ecu_mapping);
    return text.replace(text.find("Angle = \"rudder.command\", "), 26, "");
  }();
  const auto read = [&](std::string_view text) { return mapping::read_mapped(text, mapping, ecu_dbc); };
  const auto refused = read(closed_loop);
  ASSERT_FALSE(refused);
  EXPECT_THAT(
      refused.error().message,
      HasSubstr("has no 'rudder', and no signal of the target is 'rudder.command', expected a command, or "
                "[plant.commands.rudder] with 'from' or 'start_deg'"));
  const auto constant = read(with("[master_ins]", "[plant.commands.rudder]\nstart_deg = 3\n[master_ins]"));
  EXPECT_TRUE(setup_of(constant).commands.empty());
  EXPECT_DOUBLE_EQ(setup_of(constant).start.at(0), 3 * deg);
  EXPECT_FALSE(constant->closes_the_loop());
}

TEST(PlantSetup, WithoutAPlantThereIsNoSuchTrajectory) {
  std::string text(closed_loop);
  const std::size_t from = text.find("[plant]"), to = text.find("[master_ins]");
  const auto refused = read_loop(text.erase(from, to - from));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("is 'plant', but no plant moves the carrier"));
}

}  // namespace
}  // namespace canhil::plant
