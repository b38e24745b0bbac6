// Tests how a campaign file is read: its variants and sweeps, and one error line for every mistake.
#include "bench/campaign/campaign.hpp"

#include <gmock/gmock.h>

#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names_of(const Campaign& campaign) {
  std::vector<std::string> names;
  for (const Variant& variant : campaign.variants) names.push_back(variant.name);
  return names;
}

TEST(Campaign, VariantsAreTheirScenarioWithSettings) {
  const auto campaign = parse(two_variants);
  ASSERT_TRUE(campaign) << campaign.error().message;
  EXPECT_THAT(names_of(*campaign), ElementsAre("A", "B"));
  EXPECT_EQ(campaign->runs, 4U);
  EXPECT_NEAR(campaign->variants[0].scenario.targets.front().initial_sigma.heading, 0.0873, 1e-4);
  EXPECT_NEAR(campaign->variants[1].scenario.targets.front().initial_sigma.heading, 0.01745, 1e-5);
  EXPECT_NEAR(campaign->variants[1].scenario.targets.front().initial_sigma.tilt, 0.0873, 1e-4);
  EXPECT_NE(campaign->variants[0].scenario.hash, campaign->variants[1].scenario.hash);
  for (const Variant& variant : campaign->variants) EXPECT_EQ(variant.scenario.seed, 3U);
}

TEST(Campaign, TablesInSettingsAreKeysWithDots) {
  std::string text = two_variants;
  text += "[variant.set.master_ins]\nperiod_ms = 50\n";
  const auto where = text.find("set = {");
  text.erase(where, text.find('\n', where) - where);
  const auto campaign = parse(text);
  ASSERT_TRUE(campaign) << campaign.error().message;
  EXPECT_EQ(campaign->variants[1].scenario.node("master_ins")->period_us(), 50'000);
}

TEST(Campaign, WhatIsOfAllVariantsStandsOnce) {
  const auto campaign = parse(R"(title = "T"
runs = 1
seed = 3
scenario = "quick.toml"
set = { target.initial_sigma.heading_deg = 1.0, duration_s = 5.0 }
[[variant]]
name = "A"
[[variant]]
name = "B"
set = { target.initial_sigma.heading_deg = 2.0 }
)");
  ASSERT_TRUE(campaign) << campaign.error().message;
  const auto heading = [&](std::size_t i) {
    return campaign->variants.at(i).scenario.targets.front().initial_sigma.heading / world::units::deg;
  };
  EXPECT_DOUBLE_EQ(heading(0), 1);
  EXPECT_DOUBLE_EQ(heading(1), 2) << "its own replaces it";
  EXPECT_EQ(campaign->variants[1].scenario.duration_us, 5'000'000);
}

TEST(Campaign, AGroupStandsForItsVariants) {
  const std::string text = R"(title = "T"
runs = 1
seed = 3
scenario = "quick.toml"
[[variant]]
name = "A"
groups = ["good"]
[[variant]]
name = "B"
groups = ["good", "late"]
[[variant]]
name = "C"
[[metric]]
kind = "rms_curve"
quantity = "attitude.heading"
variants = )";
  const auto chosen = [&](const std::string& variants) {
    const auto campaign = parse(text + variants);
    EXPECT_TRUE(campaign) << campaign.error().message;
    return campaign->metrics.at(0).variants;
  };
  EXPECT_EQ(chosen("['good']"), (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(chosen("['C', 'late']"), (std::vector<std::string>{"B", "C"}));
  EXPECT_EQ(chosen("['B', 'good']"), (std::vector<std::string>{"A", "B"})) << "each once";
  EXPECT_FALSE(parse(text + "['bad']"));
  EXPECT_FALSE(parse(text + "['C']\n[[variant]]\nname = 'D'\ngroups = ['C']")) << "the name of a variant";
}

TEST(Campaign, DataSheetsCanBeWithheld) {
  const auto campaign = parse(R"(title = "T"
runs = 1
seed = 3
scenario = "quick.toml"
set = { slave_imu.lever_arm_m = [0.5, 0.0, 0.0] }
[[variant]]
name = "sent"
[[variant]]
name = "withheld"
set = { target.data_sheets = "withheld" }
)");
  ASSERT_TRUE(campaign) << campaign.error().message;
  const auto lever_arm = [&](std::size_t i) {
    const auto& all = campaign->variants.at(i).scenario.targets.front().parameters;
    return std::ranges::find(all, "lever_arm_sigma_m", &scenario::Parameter::name) != all.end();
  };
  EXPECT_TRUE(lever_arm(0));
  EXPECT_FALSE(lever_arm(1));
}

TEST(Campaign, SweepIsTheCartesianProductWithEveryVariant) {
  const auto campaign = parse(two_variants + R"([sweep]
"master_ins.period_ms" = [50, 100]
"target.parameters.fading_per_s" = [0.0, 0.1]
[[metric]]
kind = "paired"
quantity = "attitude.heading"
at_s = 2.0
other = "A"
)");
  ASSERT_TRUE(campaign) << campaign.error().message;
  ASSERT_EQ(campaign->variants.size(), 8U);
  EXPECT_EQ(campaign->variants[1].name, "A master_ins.period_ms=50 target.parameters.fading_per_s=0.1");
  EXPECT_EQ(campaign->variants[6].name, "B master_ins.period_ms=100 target.parameters.fading_per_s=0");
  EXPECT_EQ(campaign->variants[6].scenario.node("master_ins")->period_us(), 100'000);
  EXPECT_THAT(variants_of(*campaign, campaign->metrics[0]), ElementsAre(4, 5, 6, 7));
  EXPECT_EQ(counterpart(*campaign, 6, "A"), 2U);  // A at the same point of the sweep
}

TEST(Campaign, HashIsOfAllTexts) {
  const auto first = parse(two_variants), second = parse(two_variants + "\n");
  const auto other_scenario =
      parse_campaign(two_variants, "c.toml",
                     [](const std::string&) -> Result<std::string> { return quick_scenario() + "\n"; });
  EXPECT_EQ(first->hash, parse_campaign(first->sources)->hash);
  EXPECT_NE(first->hash, second->hash);
  EXPECT_NE(first->hash, other_scenario->hash);
}

struct Mistake {
  std::string what;
  std::string text;
  std::string said;
};
std::ostream& operator<<(std::ostream& out, const Mistake& mistake) { return out << mistake.what; }

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreOneLine) {
  const auto campaign = parse(GetParam().text);
  ASSERT_FALSE(campaign);
  EXPECT_THAT(campaign.error().message, HasSubstr(GetParam().said));
  EXPECT_EQ(campaign.error().message.find('\n'), std::string::npos);
}

std::string metric(const std::string& keys) { return two_variants + "[[metric]]\n" + keys; }
std::string numbers(int count) {
  std::string list;
  for (int i = 0; i < count; ++i) list += fmt::format("{}, ", i);
  return list;
}
std::string with_set(const std::string& set) {
  std::string text = two_variants;
  const auto where = text.find("set = {");
  return text.replace(where, text.find('\n', where) - where, "set = " + set);
}

INSTANTIATE_TEST_SUITE_P(
    Of, Mistakes,
    testing::Values(
        Mistake{"not TOML", "title = ", "c.toml:1: not TOML"},
        Mistake{"no variant", "title = 'x'\nruns = 1\nseed = 1\n", "key 'variant': is missing"},
        Mistake{"no runs", "runs = 0\n" + two_variants.substr(two_variants.find("seed")),
                "c.toml:1: key 'runs': 0 is out of range"},
        Mistake{"unknown key", "colour = 1\n" + two_variants, "c.toml:1: key 'colour': is unknown"},
        Mistake{"same name", two_variants + "[[variant]]\nname = 'A'\nscenario = 'quick.toml'\n",
                "'A' is already the name of another variant"},
        Mistake{"no such scenario", two_variants + "[[variant]]\nname = 'C'\nscenario = 'none.toml'\n",
                "c.toml:11: variant 'C': none.toml: cannot be read"},
        Mistake{
            "setting of unknown key", with_set("{ \"master_ins.perod_ms\" = 50 }"),
            "c.toml:7: variant 'B': quick.toml: key 'master_ins.perod_ms': is unknown, expected 'period_ms'"},
        Mistake{"setting out of range", with_set("{ \"target.initial_sigma.tilt_deg\" = -1 }"),
                "variant 'B': quick.toml: key 'target.initial_sigma.tilt_deg': -1 is out of range"},
        Mistake{"setting of another type", with_set("{ duration_s = 'long' }"),
                "key 'duration_s': is a string"},
        Mistake{"setting inside a value", with_set("{ \"title.sub\" = 1 }"),
                "key 'title.sub': 'title' is a string, expected a table"},
        Mistake{"setting of the seed", with_set("{ seed = 1 }"), "is the same for all variants"},
        Mistake{
            "too many variants",
            two_variants + "[sweep]\n\"master_ins.latency_ms\" = [" + numbers(200) +
                "]\n\"slave_imu.latency_ms\" = [" + numbers(200) + "]\n",
            "key 'sweep.slave_imu.latency_ms': makes more variants than can be looked at, expected at most "
            "10000 in all"},
        Mistake{"empty sweep", two_variants + "[sweep]\n", "key 'sweep': is empty"},
        Mistake{"sweep without values", two_variants + "[sweep]\n\"master_ins.period_ms\" = []\n",
                "key 'sweep.master_ins.period_ms': is empty, expected an array"},
        Mistake{"sweep of one value", two_variants + "[sweep]\n\"master_ins.period_ms\" = 50\n",
                "is not an array"},
        Mistake{"same value twice", two_variants + "[sweep]\n\"master_ins.period_ms\" = [50, 50]\n",
                "is there twice"},
        Mistake{"set and swept", two_variants + "[sweep]\n\"target.initial_sigma.heading_deg\" = [1, 2]\n",
                "is set by variant 'B' too"},
        Mistake{"unknown kind", metric("kind = 'pared'\n"),
                "key 'metric[1].kind': 'pared' is unknown, expected 'paired'"},
        Mistake{"quantity of single runs", metric("kind = 'rms_curve'\nquantity = 'position.norm'\n"),
                "'position.norm' exists in single runs only, not in campaigns, expected one of: "},
        Mistake{"no degrees of freedom", metric("kind = 'consistency'\nquantity = 'attitude.heading'\n"),
                "'attitude.heading' cannot be used with this kind, expected one of: "},
        Mistake{"unknown quantity", metric("kind = 'rms_curve'\nquantity = 'attitude.heding'\n"),
                "'attitude.heding' is unknown, expected 'attitude.heading'"},
        Mistake{"unknown variant",
                metric("kind = 'rms_curve'\nquantity = 'attitude.roll'\nvariants = ['C']\n"),
                "key 'metric[1].variants': 'C' is unknown"},
        Mistake{"another unit",
                metric("kind = 'value_at'\nquantity = 'velocity.east'\nat_s = 1\nat_most_mrad = 2\n"),
                "key 'metric[1].at_most_mrad': is unknown, expected 'at_most_mps'"},
        Mistake{"after the end", metric("kind = 'value_at'\nquantity = 'velocity.east'\nat_s = 4\n"),
                "at_s': is after the end of the run, expected at most duration_s = 3"},
        Mistake{"compared with itself",
                metric("kind = 'paired'\nquantity = 'attitude.roll'\nat_s = 1\nother = 'A'\nvariants = ['B', "
                       "'A']\n"),
                "key 'metric[1].other': 'A' would be compared with itself, expected another variant"},
        Mistake{"nobody to compare with",
                two_variants.substr(0, two_variants.rfind("[[variant]]")) +
                    "[[metric]]\nkind = 'lead'\nquantity = 'attitude.roll'\nwithin_mrad = 1\nother = 'A'\n",
                "key 'metric[1].other': 'A' would be compared with itself"},
        Mistake{
            "of another family", metric("kind = 'rms_curve'\nquantity = 'miss.distance'\n"),
            "'rms_curve miss.distance' asks for miss.distance, which variant 'A' does not report, expected "
            "a quantity of its "
            "estimator"},
        Mistake{"of another estimator", metric("kind = 'rms_curve'\nquantity = 'position.north'\n"),
                "'rms_curve position.north' asks for position.north, which variant 'A' does not report"},
        Mistake{"repairs of transfer alignment",
                metric("kind = 'rms_curve'\nquantity = 'covariance.repairs'\n"),
                "asks for covariance.repairs, which variant 'A' does not report"},
        Mistake{"bars that exclude each other",
                metric("kind = 'value_at'\nquantity = 'attitude.roll'\nat_s = 1\nat_least_mrad = "
                       "2\nat_most_mrad = 1\n"),
                "key 'metric[1].at_least_mrad': is more than at_most_mrad, expected a lower limit below the "
                "upper"},
        Mistake{"ratios that exclude each other",
                metric("kind = 'run_mean'\nquantity = 'attitude.roll'\nother = 'A'\nratio_at_least = "
                       "2\nratio_at_most = 1\n"),
                "key 'metric[1].ratio_at_least': is more than ratio_at_most"},
        Mistake{"counts that exclude each other",
                metric("kind = 'divergence'\nquantity = 'attitude.roll'\nbeyond_mrad = 1\nat_least = "
                       "2\nat_most = 1\n"),
                "key 'metric[1].at_least': is more than at_most"},
        Mistake{"never before and at most",
                metric("kind = 'time_within'\nquantity = 'attitude.roll'\nwithin_mrad = 1\nnever_before_s = "
                       "2\nat_most_s = 1\n"),
                "key 'metric[1].never_before_s': is more than at_most_s"},
        Mistake{"empty window", metric("kind = 'window'\nquantity = 'attitude.roll'\nfrom_s = 2\nto_s = 2\n"),
                "is not before the end of the window"},
        Mistake{"metric twice",
                metric("kind = 'rms_curve'\nquantity = 'attitude.roll'\n[[metric]]\nkind = "
                       "'rms_curve'\nquantity = 'attitude.roll'\n"),
                "'rms_curve attitude.roll' is already the name of another metric"}));

}  // namespace
}  // namespace canhil::campaign
