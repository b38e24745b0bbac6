#include "target/estimators/filtering/mean_charts.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace canhil::filtering {
namespace {

using Innovation = std::array<double, 3>;

struct White {
  std::mt19937_64 random{20261128};
  std::normal_distribution<double> normal;
  Innovation operator()(double bias) { return {normal(random), normal(random) + bias, normal(random)}; }
};

// The number of updates until the alarm is on or off; `most` if it never is.
int updates_until(MeanCharts<3>& charts, bool alarmed, int most, White& white, double bias) {
  for (int i = 0; i < most; ++i) {
    charts.are_beyond(white(bias));
    if (charts.alarmed() == alarmed) return i + 1;
  }
  return most;
}

TEST(MeanCharts, SeeALastingMeanAndAreQuietWithoutIt) {
  White white;
  int false_alarms = 0;
  for (int run = 0; run < 200; ++run) {
    MeanCharts<3> charts;
    false_alarms += updates_until(charts, true, 300, white, 0) < 300 ? 1 : 0;
  }
  EXPECT_LE(false_alarms, 2) << "of 200 runs with 300 updates";

  for (const auto& [bias, within] : {std::pair(3.0, 8), std::pair(1.0, 60), std::pair(0.5, 250)}) {
    MeanCharts<3> charts;
    updates_until(charts, true, 50, white, 0);
    EXPECT_LE(updates_until(charts, true, 2'000, white, bias), within) << bias;
    EXPECT_GT(charts.mean(1).value, 0.25 * bias) << bias;
    EXPECT_LT(charts.mean(1).value, 2 * bias) << bias;
    EXPECT_GT(updates_until(charts, false, 2'000, white, bias), 20) << "the cause is there";
  }
}

TEST(MeanCharts, TheAlarmEndsAfterTwiceTheMemoryWithoutTheCause) {
  MeanCharts<3> charts;
  const Innovation biased{4, 0, 0}, none{0, 0, 0};
  int until = 0;
  while (++until < 100 && !charts.are_beyond(biased)) {
  }
  EXPECT_EQ(until, 2) << "two innovations of 4 sigmas: a mean of 5.7";
  charts.restart();
  EXPECT_TRUE(charts.alarmed());
  for (int i = 0; i < 16; ++i) EXPECT_FALSE(charts.are_beyond(none));
  EXPECT_TRUE(charts.alarmed()) << "it judges from its second update on";
  EXPECT_FALSE(charts.are_beyond(none));
  EXPECT_FALSE(charts.alarmed());
}

TEST(MeanCharts, AreBeyondAnewAfterARestart) {
  MeanCharts<3> charts;
  const Innovation biased{0, -4, 0};
  charts.are_beyond(biased);
  EXPECT_TRUE(charts.are_beyond(biased));
  EXPECT_TRUE(charts.are_beyond(biased)) << "as long as the mean is";
  charts.restart();
  EXPECT_FALSE(charts.are_beyond(biased));
  EXPECT_TRUE(charts.are_beyond(biased));
}

TEST(MeanCharts, AValueCountsAtMostFourSigmas) {
  for (const double huge :
       {1e9, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    MeanCharts<3> charts;
    EXPECT_FALSE(charts.are_beyond(Innovation{huge, 0, -huge}));
    EXPECT_DOUBLE_EQ(std::abs(charts.mean(0).value), 4);
    EXPECT_FALSE(charts.alarmed());
  }
}

}  // namespace
}  // namespace canhil::filtering
