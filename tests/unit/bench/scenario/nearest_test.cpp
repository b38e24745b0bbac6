#include "bench/scenario/nearest.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace canhil::scenario {
namespace {

const std::vector<std::string> names{"period_ms", "latency_ms", "velocity_noise_mps", "axis"};

TEST(Nearest, FindsWhatWasMeant) {
  EXPECT_EQ(nearest("perod_ms", names), "period_ms");
  EXPECT_EQ(nearest("periods_ms", names), "period_ms");
  EXPECT_EQ(nearest("latency", names), "latency_ms") << "the unit was forgotten";
  EXPECT_EQ(nearest("Wind", std::vector<std::string>{"Windy", "WindUpdate"}), "WindUpdate");
  EXPECT_EQ(nearest("los.rate", std::vector<std::string>{"los.rates_", "los.rate.pitch"}), "los.rate.pitch");
  EXPECT_EQ(nearest("latenz", names), "") << "five edits in six letters are too many";
  EXPECT_EQ(nearest("latency_m", names), "latency_ms");
  EXPECT_EQ(nearest("velocity_sigma_mps", names), "velocity_noise_mps");
  EXPECT_EQ(nearest("axes", names), "axis");
}

TEST(Nearest, LeavesStrangersAlone) {
  EXPECT_EQ(nearest("banana_split", names), "");
  EXPECT_EQ(nearest("", names), "");
  EXPECT_EQ(nearest(std::string(1'000'000, 'a'), names), "");
  EXPECT_EQ(nearest("axis", {}), "");
}

TEST(Nearest, ExpectedIsTheNearestOrAll) {
  EXPECT_EQ(expected_instead("axes", names), "'axis'");
  EXPECT_EQ(expected_instead("qqqqqq", names), "one of: period_ms, latency_ms, velocity_noise_mps, axis");
  EXPECT_EQ(expected_instead("qqqqqq", {}), "none");
}

}  // namespace
}  // namespace canhil::scenario
