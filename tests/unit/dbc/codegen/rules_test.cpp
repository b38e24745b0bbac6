#include "dbc/codegen/rules.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "dbc/parser/parse.hpp"
#include "dbc/wire/generated.hpp"

namespace canhil::dbc {
namespace {

/// The rule that a signal with this name, scale, sigma and CarriesRemainder violates; empty: no rule.
std::string breach(std::string_view name, double scale, double sigma, bool carries) {
  const auto database =
      parse(fmt::format("BS_:\nBU_: A\nBO_ 1 M: 8 A\n SG_ {} : 0|16@1- ({},0) [0|0] \"\" A\n"
                        "BA_DEF_ SG_ \"SensorSigma\" FLOAT 0 1000;\n"
                        "BA_DEF_ SG_ \"CarriesRemainder\" ENUM \"no\",\"yes\";\n"
                        "BA_ \"SensorSigma\" SG_ 1 {} {};\nBA_ \"CarriesRemainder\" SG_ 1 {} {};\n",
                        name, scale, name, sigma, name, carries ? 1 : 0),
            "x.dbc");
  EXPECT_TRUE(database) << database.error().message;
  const auto found = find_breach(*database);
  return found ? found->what : "";
}

// For a sigma of 1, the coarsest permitted LSB is sqrt(12) / 4 = 0.8660254.
TEST(QuantisationRule, LsbOverSqrt12IsAtMostAQuarterOfSigma) {
  EXPECT_EQ(breach("v", 0.8660, 1, false), "");
  EXPECT_EQ(breach("v", -0.8660, 1, false), "");
  EXPECT_EQ(breach("v", 0.8661, 1, false),
            "signal M.v has LSB 0.8661 for a sensor sigma of 1, expected LSB / sqrt(12) <= sigma / 4: at "
            "most 0.866");
  EXPECT_NE(breach("v", -0.8661, 1, false), "");
}

TEST(QuantisationRule, SignalsThatAreNoMeasurementsAreFree) { EXPECT_EQ(breach("v", 1000, 0, false), ""); }

TEST(QuantisationRule, IncrementsCarryTheirRemainder) {
  EXPECT_EQ(breach("delta_v", 0.1, 1, true), "");
  EXPECT_EQ(breach("delta_v", 0.1, 1, false),
            "signal M.delta_v is an increment, expected the attribute CarriesRemainder \"yes\"");
}

TEST(QuantisationRule, WhatCarriesARemainderIsJudgedBySomeSensor) {
  EXPECT_EQ(breach("delta_v", 0.1, 0, true),
            "signal M.delta_v carries its remainder but has no sensor, expected SensorSigma > 0");
}

TEST(QuantisationRule, TheHeaderAssertsTheSame) {
  constexpr SignalInfo fine{.name = "v", .scale = 0.8, .sensor_sigma = 1};
  constexpr SignalInfo coarse{.name = "v", .scale = 0.9, .sensor_sigma = 1};
  EXPECT_TRUE(wire::is_fine_enough({&fine, 1}));
  EXPECT_FALSE(wire::is_fine_enough({&coarse, 1}));
}

TEST(SoundLayout, AssertsBoundsOverlapAndProtection) {
  const std::array apart{SignalInfo{.start_bit = 0, .length = 8},
                         SignalInfo{.start_bit = 15, .length = 8, .big_endian = true}};
  const std::array overlapping{SignalInfo{.start_bit = 0, .length = 9},
                               SignalInfo{.start_bit = 8, .length = 8}};
  EXPECT_TRUE(wire::is_sound({.size = 2}, apart));
  EXPECT_FALSE(wire::is_sound({.size = 1}, apart));
  EXPECT_FALSE(wire::is_sound({.size = 2}, overlapping));
  EXPECT_FALSE(wire::is_sound({.size = 2, .e2e_data_id = 1}, apart));
}

/// Messages M and N of node B are the sample group "Right" and have these attributes; message L of node A is
/// the group "Left". Returns the violated rule; empty: none.
std::string answer_breach(std::string_view of_m, std::string_view of_n) {
  const auto database =
      parse(fmt::format("BS_:\nBU_: A B\nBO_ 1 L: 8 A\nBO_ 2 M: 8 B\nBO_ 3 N: 8 B\n"
                        "BA_DEF_ BO_ \"SampleGroup\" STRING ;\nBA_DEF_ BO_ \"Answers\" STRING ;\n"
                        "BA_ \"SampleGroup\" BO_ 1 \"Left\";\nBA_ \"SampleGroup\" BO_ 2 \"Right\";\n"
                        "BA_ \"SampleGroup\" BO_ 3 \"Right\";\n"
                        "BA_ \"Answers\" BO_ 2 \"{}\";\nBA_ \"Answers\" BO_ 3 \"{}\";\n",
                        of_m, of_n),
            "x.dbc");
  EXPECT_TRUE(database) << database.error().message;
  const auto found = find_breach(*database);
  return found ? found->what : "";
}

TEST(AnswerRule, WhatIsAnsweredIsASampleGroupOfAnotherNode) {
  EXPECT_EQ(answer_breach("Left", " Left "), "");
  EXPECT_EQ(answer_breach("", ""), "");
  EXPECT_EQ(answer_breach("Up", "Up"), "message M answers Up, expected the sample groups of other nodes");
  EXPECT_EQ(answer_breach("Right", "Right"),
            "message M answers Right, expected the sample groups of other nodes");
}

TEST(AnswerRule, AGroupAnswersAsAWhole) {
  EXPECT_EQ(answer_breach("Left", ""), "message N answers \"\", expected \"Left\" as M of its sample group");
}

TEST(QuantisationTable, ListsEveryMeasurementOfTheContract) {
  const auto database = read_file(SOURCE_DIR "/dbc/canhil.dbc");
  ASSERT_TRUE(database);
  EXPECT_EQ(find_breach(*database), std::nullopt) << find_breach(*database)->what;
  const std::string table = quantisation_table(*database);
  EXPECT_THAT(
      table,
      testing::HasSubstr(
          "SlaveImuDeltaTheta.delta_theta_x_rad              2e-06     2.57e-06    0.225    carried  ok\n"));
  EXPECT_THAT(table, testing::Not(testing::HasSubstr("AlignAttitude")));
}

}  // namespace
}  // namespace canhil::dbc
