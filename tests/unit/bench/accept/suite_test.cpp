// Tests that the suites of the project are read, and that invalid suites are rejected.
#include "bench/accept/suite.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "bench/campaign/campaign.hpp"
#include "target/device/device.hpp"
#include "tests/own_folder.hpp"

namespace canhil::accept {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path shipped = SOURCE_DIR "/bench/acceptance";

class Shipped : public testing::TestWithParam<const char*> {
 protected:
  Shipped() : suite_(read_suite(shipped / GetParam())) {}
  const Result<Suite> suite_;
};

TEST_P(Shipped, IsReadWithAllThatItNames) {
  ASSERT_TRUE(suite_) << suite_.error().message;
  EXPECT_EQ(suite_->estimator, GetParam());
}

TEST_P(Shipped, EveryMetricAsksForARequirement) {
  ASSERT_TRUE(suite_);
  for (const std::string& one : suite_->campaigns) {
    const auto campaign = campaign::read_campaign(shipped / GetParam() / one);
    ASSERT_TRUE(campaign) << campaign.error().message;
    for (const campaign::Metric& metric : campaign->metrics)
      EXPECT_NE(suite_->find(metric.requirement), nullptr) << metric.name;
  }
}

// The suite states the parameter ranges in its own table, so that any target is compared with the published
// ranges and not with those of hil-target. This test verifies that the ranges of the suite equal those of
// hil-target.
class OfOneEstimator : public Shipped {};

TEST_P(OfOneEstimator, RangesAreThoseOfTheTarget) {
  ASSERT_TRUE(suite_);
  const auto estimator = messages::from_name<messages::Estimator>(GetParam());
  ASSERT_TRUE(estimator);
  for (const auto one : messages::enumerators<messages::Parameter>) {
    const auto range = target::Device().range(*estimator, one);
    const auto found = std::ranges::find(suite_->parameters, name_of(one), &Parameter::name);
    ASSERT_EQ(range.has_value(), found != suite_->parameters.end()) << name_of(one);
    if (!range) continue;
    EXPECT_EQ(range->minimum, found->least) << found->name;
    EXPECT_EQ(range->maximum, found->most) << found->name;
    EXPECT_EQ(range->whole, found->whole) << found->name;
  }
}

const auto by_name = [](const auto& one) { return std::string(one.param); };
const auto estimators = testing::Values("transfer_alignment", "inflight_alignment", "los_rate", "wind");
INSTANTIATE_TEST_SUITE_P(Estimators, Shipped, estimators, by_name);
INSTANTIATE_TEST_SUITE_P(Together, Shipped, testing::Values("several"), by_name);
INSTANTIATE_TEST_SUITE_P(Estimators, OfOneEstimator, estimators, by_name);

TEST(Suites, EachEstimatorHasOne) {
  const auto found = suites_in(shipped);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->size(), 5U);  // one suite for each of the four estimators, one suite for several at once
  EXPECT_FALSE(suites_in("/no/such/folder"));
}

constexpr std::string_view good = R"(title = "T"
estimator = "wind"
[[requirement]]
id = "R"
family = "errors"
text = "It is."
[[flight]]
name = "f"
scenario = "wind.toml"
requirement = "R"
)";

std::string refused(const std::string& more, std::string_view was = "", std::string_view is = "") {
  const fs::path folder = test::own_folder();
  fs::create_directories(folder);
  fs::copy_file(SOURCE_DIR "/bench/flights/wind_quick.toml", folder / "wind.toml",
                fs::copy_options::overwrite_existing);
  std::string text(good);
  if (!was.empty()) text.replace(text.find(was), was.size(), is);
  std::ofstream(folder / "suite.toml") << text << more;
  const auto read = read_suite(folder);
  return read ? "" : read.error().message;
}

TEST(Suites, AWrongOneIsOneLine) {
  EXPECT_EQ(refused(""), "");
  EXPECT_THAT(refused("", "errors", "error"),
              HasSubstr("suite.toml:5: key 'requirement[1].family': 'error'"));
  EXPECT_THAT(refused("", "requirement = \"R\"", "requirement = \"Q\""),
              HasSubstr("'Q' is not a requirement of this suite"));
  EXPECT_THAT(refused("", "wind.toml", "none.toml"), HasSubstr("none.toml: cannot be read"));
  EXPECT_THAT(refused("set = { \"seeds\" = 1 }\n"), HasSubstr("seeds"));
  EXPECT_THAT(refused("beside = \"g\"\nmoves = { signal = \"WindUpdate.nis\", to = \"more\" }\n"),
              HasSubstr("'g' is not the name of an earlier flight"));
  EXPECT_THAT(refused("[[flight]]\nname = \"g\"\nscenario = \"wind.toml\"\nrequirement = \"R\"\n"
                      "beside = \"f\"\nmoves = { signal = \"WindUpdate.niss\", to = \"more\" }\n"),
              HasSubstr("WindUpdate.niss"));
  const auto moves = [](const std::string& keys) {
    return refused(
        "[[flight]]\nname = \"g\"\nscenario = \"wind.toml\"\nrequirement = \"R\"\n"
        "beside = \"f\"\nmoves = [{ signal = \"WindUpdate.nis\"" +
        keys + " }]\n");
  };
  EXPECT_EQ(moves(", by = [1, 2]"), "");
  EXPECT_THAT(moves(""), HasSubstr("by"));
  EXPECT_THAT(moves(", by = [2, 1]"), HasSubstr("descending"));
  EXPECT_THAT(moves(", by = [1, 2], to = \"more\""), HasSubstr("beside 'by'"));
  EXPECT_EQ(moves(", first_at_s = 3"), "");
  EXPECT_THAT(moves(", first_at_s = -1"), HasSubstr("first_at_s"));
  EXPECT_THAT(moves(", first_at_s = 3, by = [1, 2]"), HasSubstr("beside 'first_at_s'"));
  EXPECT_THAT(refused("[[flight]]\nname = \"g\"\nscenario = \"wind.toml\"\nrequirement = \"R\"\n"
                      "moves = { signal = \"WindUpdate.nis\", to = \"more\" }\n"),
              HasSubstr("'flight[2].beside': is missing"));
  EXPECT_THAT(
      refused("[[flight]]\nname = \"g\"\nscenario = \"wind.toml\"\nrequirement = \"R\"\nbeside = \"f\"\n"
              "moves = { signal = \"LosRateEstimate.los_rate_pitch_radps\", to = \"more\" }\n"),
      HasSubstr("is in no message that wind sends"));
  EXPECT_THAT(refused("", "estimator = \"wind\"", "estimator = \"wnid\""), HasSubstr("'wnid' is unknown"));
  EXPECT_THAT(refused("", "estimator = \"wind\"", "estimator = \"los_rate\""),
              HasSubstr("wind.toml has no estimator los_rate"));
  EXPECT_THAT(refused("[[parameter]]\nname = \"theta_per_s\"\nleast = 0\nmost = 1\n"),
              HasSubstr("'parameter': is given without 'dialogue'"));
  EXPECT_THAT(refused("[[parameter]]\nname = \"theta_per_s\"\nleast = 2\nmost = 1\n"),
              HasSubstr("'parameter[1].most': is 1, expected at least 2"));
  EXPECT_THAT(refused("beside = \"f\"\n"), HasSubstr("beside': is given without 'moves'"));
  EXPECT_THAT(refused("[[flight]]\nname = \"f\"\nscenario = \"wind.toml\"\nrequirement = \"R\"\n"),
              HasSubstr("'f' is given twice"));
  EXPECT_THAT(refused("rows = 0\n"), HasSubstr("rows"));
  EXPECT_THAT(refused("[[parameter]]\nname = \"none\"\nleast = 0\nmost = 1\n"), HasSubstr("name"));
  EXPECT_THAT(refused("[[more]]\na = 1\n"), HasSubstr("more"));
}

}  // namespace
}  // namespace canhil::accept
