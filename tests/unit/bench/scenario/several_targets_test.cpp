// [[target]]: several estimators on one target.
#include <gmock/gmock.h>

#include "bench/checks/kinds/bus_load.hpp"
#include "bench/checks/kinds/error.hpp"

#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string second = R"([[target]]
estimator = "inflight_alignment"
algorithm = "kalman"
initial_sigma = { velocity_mps = 0.1, tilt_deg = 1.0, heading_deg = 90.0, position_m = 5.0 }
initial_error = { heading_magnitude_deg = 90.0 }
)";

// The scenario `valid` with a second estimator, and with GPS for that estimator.
std::string two(std::string_view other = second, std::string_view check = "") {
  const std::string several = with("[target]", "[[target]]");
  return with("[truth]", std::string(other) + "[gps]\n" + std::string(check) + "[truth]", several);
}

std::string refusal(const std::string& text) {
  const auto scenario = parse(text, "s.toml", contract);
  return scenario ? "accepted" : scenario.error().message;
}

TEST(SeveralTargets, EachHasItsOwnSettings) {
  const Scenario s = parsed(two());
  ASSERT_EQ(s.targets.size(), 2U);
  EXPECT_TRUE(s.runs("transfer_alignment"));
  EXPECT_TRUE(s.runs("inflight_alignment"));
  EXPECT_FALSE(s.runs("los_rate"));
  EXPECT_FALSE(s.targets[0].initial_error) << "the scenario's";
  EXPECT_DOUBLE_EQ(s.targets[1].initial_error->heading_magnitude, 90 * world::units::deg);
  EXPECT_DOUBLE_EQ(s.targets[1].initial_sigma.position, 5);
}

TEST(SeveralTargets, EachBringsItsNodes) {
  const std::string without = with("[gps]\n", "", two());
  EXPECT_THAT(refusal(without), HasSubstr("key 'ssbl': is missing"));
}

TEST(SeveralTargets, AnEstimatorIsThereOnce) {
  const std::string twice = with("\"inflight_alignment\"", "\"transfer_alignment\"", two());
  EXPECT_EQ(refusal(twice),
            "s.toml:9: key 'target[2].estimator': 'transfer_alignment' is the name of another [[target]] "
            "too, expected each estimator once");
}

TEST(SeveralTargets, OneThatIsSentNoStateHasNoErrorOfIt) {
  const std::string seeker =
      "[[target]]\nestimator = 'los_rate'\nalgorithm = 'kalman'\ninitial_error = { attitude_sigma_deg = 1 "
      "}\n";
  EXPECT_EQ(refusal(two(second + seeker)),
            "s.toml:16: key 'target[3].initial_error': has no effect on 'los_rate', expected no such table");
}

TEST(SeveralTargets, ErrorsNameWhichOne) {
  EXPECT_THAT(refusal(with("heading_deg = 90.0, ", "", two())),
              HasSubstr("key 'target[2].initial_sigma.heading_deg': is missing"));
}

TEST(SeveralTargets, ACheckOfNobodyIsACheckOfEach) {
  const std::string error = "[[check]]\nkind = 'error'\nquantity = 'attitude.roll'\nbelow_mrad = 5\n";
  const std::string answers = "[[check]]\nkind = 'answers'\ncoasting_at_most = 0\nname = 'coasting'\n";
  const Scenario s = parsed(two(second, error + answers));
  std::vector<std::string> names, judged;
  for (const Check& check : s.checks) names.push_back(check.name);
  EXPECT_THAT(
      names,
      ElementsAre("error attitude.roll of transfer_alignment", "error attitude.roll of inflight_alignment",
                  "coasting of transfer_alignment", "coasting of inflight_alignment", "heartbeat"));
  EXPECT_EQ(rule_of<checks::Error>(s.checks.at(0)).judged.estimator, "transfer_alignment");
  EXPECT_EQ(rule_of<checks::Error>(s.checks.at(1)).judged.estimator, "inflight_alignment");
}

TEST(SeveralTargets, ACheckSaysWhoseAnswersItIsAbout) {
  const std::string check = "[[check]]\nkind = 'error'\nquantity = 'attitude.roll'\nbelow_mrad = 5\n";
  const Scenario s = parsed(two(second, check + "estimator = 'inflight_alignment'\n"));
  EXPECT_EQ(rule_of<checks::Error>(s.checks.at(0)).judged.estimator, "inflight_alignment");
  EXPECT_EQ(s.checks.at(0).name, "error attitude.roll of inflight_alignment");
}

TEST(SeveralTargets, WhereOneAlignsItIsTheOneThatIsMeant) {
  const std::string check = "[[check]]\nkind = 'error'\nquantity = 'attitude.roll'\nbelow_mrad = 5\n";
  const Scenario s = parsed(with("[[check]]", check + "[[check]]"));
  EXPECT_EQ(rule_of<checks::Error>(s.checks.at(0)).judged.estimator, "transfer_alignment");
  EXPECT_THAT(refusal(with("[[check]]", check + "estimator = 'inflight_alignment'\n[[check]]")),
              HasSubstr("'inflight_alignment' is unknown, expected one of: transfer_alignment"));
}

TEST(BusLoadCheck, HasABitrateAndABar) {
  const Scenario s = parsed(
      with("[[check]]", "[[check]]\nkind = 'bus_load'\nbitrate_kbitps = 500\nbelow_percent = 40\n[[check]]"));
  const auto rule = rule_of<checks::BusLoad>(s.checks.at(0));
  EXPECT_EQ(rule.bitrate, 500'000);
  EXPECT_EQ(rule.data_bitrate, 0);
  EXPECT_DOUBLE_EQ(rule.below, 0.4);
  EXPECT_EQ(s.checks.at(0).name, "bus_load at 500 kbit/s");
}

TEST(BusLoadCheck, BitRatesAreThoseOfCan) {
  const auto refused = [](std::string_view rates) {
    return refusal(with("[[check]]", "[[check]]\nkind = 'bus_load'\nbelow_percent = 40\n" +
                                         std::string(rates) + "\n[[check]]"));
  };
  EXPECT_THAT(refused("bitrate_kbitps = 500000"),
              HasSubstr("is faster than CAN, expected kbit/s, at most 1000"));
  EXPECT_THAT(refused("bitrate_kbitps = 500\ndata_bitrate_kbitps = 200"),
              HasSubstr("is 200, expected from bitrate_kbitps to 8000"));
  EXPECT_EQ(refused("bitrate_kbitps = 500\ndata_bitrate_kbitps = 2000"), "accepted");
}

}  // namespace
}  // namespace canhil::scenario
