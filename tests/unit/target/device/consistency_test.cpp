#include "target/device/consistency.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace canhil::target {
namespace {

using Innovation = std::vector<double>;

// The number of updates until the monitor reaches the state; `most` if it never does.
template <class Draw>
int updates_until(ConsistencyMonitor& monitor, bool degraded, int most, Draw draw) {
  for (int i = 0; i < most; ++i) {
    const Innovation z = draw();
    monitor.observe(std::inner_product(z.begin(), z.end(), z.begin(), 0.0), z);
    if (monitor.degraded() == degraded) return i + 1;
  }
  return most;
}

TEST(ConsistencyMonitor, TrustsWhatIsConsistentAndReportsWhatIsNot) {
  for (const std::size_t m : {1U, 2U, 3U, 9U}) {
    SCOPED_TRACE(m);
    std::mt19937_64 random(20261123U + m);
    std::normal_distribution<double> white;
    const auto draws = [&](double sigma, double bias) {
      return [&, sigma, bias] {
        Innovation z(m);
        std::ranges::generate(z, [&] { return sigma * white(random); });
        z.back() += bias;
        return z;
      };
    };
    ConsistencyMonitor monitor;
    EXPECT_EQ(updates_until(monitor, true, 100'000, draws(1, 0)), 100'000) << "false alarm";
    EXPECT_LT(updates_until(monitor, true, 100'000, draws(3, 0)), 40) << "three times the sigma";
    EXPECT_EQ(updates_until(monitor, false, 1'000, draws(3, 0)), 1'000) << "it stays so";
    EXPECT_LT(updates_until(monitor, false, 100'000, draws(1, 0)), 5'000)
        << "quiet for as long as it remembers";
    // A bias of 0.4 sigma makes NIS larger by 0.16.
    EXPECT_LT(updates_until(monitor, true, 100'000, draws(1, 0.4)), 1'000) << "what is wrong stays";
    EXPECT_LT(updates_until(monitor, false, 100'000, draws(1, 0)), 5'000)
        << "quiet for as long as it remembers";
    // A filter whose errors are smaller than its sigmas is not degraded.
    EXPECT_EQ(updates_until(monitor, true, 10'000, draws(0.3, 0)), 10'000);
  }
}

// The innovations of a filter that takes correlated noise for white are correlated, however small they are.
TEST(ConsistencyMonitor, ReportsCorrelatedInnovationsOfAnySize) {
  for (const std::size_t m : {2U, 3U, 9U}) {
    for (const double sigma : {0.3, 1.0}) {
      SCOPED_TRACE(m);
      SCOPED_TRACE(sigma);
      std::mt19937_64 random(20261128U + m);
      std::normal_distribution<double> white;
      Innovation z(m, 0.0);
      const auto correlated = [&](double kept) {
        return [&, kept] {
          for (double& one : z) one = kept * one + sigma * std::sqrt(1 - kept * kept) * white(random);
          return z;
        };
      };
      ConsistencyMonitor monitor;
      EXPECT_EQ(updates_until(monitor, true, 100'000, correlated(0)), 100'000) << "false alarm";
      EXPECT_LT(updates_until(monitor, true, 1'000, correlated(0.8)), 100) << "half a second at 10 Hz";
      EXPECT_EQ(updates_until(monitor, false, 3'000, correlated(0.8)), 3'000) << "it stays so";
      EXPECT_LT(updates_until(monitor, false, 10'000, correlated(0)), 5'000);
    }
  }
}

// An estimator that considers lasting errors expects a mean that is not zero.
TEST(ConsistencyMonitor, AllowsForWhatTheEstimatorConsiders) {
  std::mt19937_64 random(20261129U);
  std::normal_distribution<double> white;
  const auto updates_with = [&](double bias, double share) {
    ConsistencyMonitor monitor;
    for (int i = 0; i < 20'000; ++i) {
      const std::array z{std::sqrt(1 - share) * white(random) + bias, white(random)}, lasting{share, 0.0};
      monitor.observe(z[0] * z[0] + z[1] * z[1], z, lasting);
      if (monitor.degraded()) return i;
    }
    return 20'000;
  };
  EXPECT_LT(updates_with(0.5, 0), 1'000);
  EXPECT_EQ(updates_with(0.5, 0.1), 20'000) << "1.6 times its sigma";
  EXPECT_LT(updates_with(2.5, 0.1), 1'000) << "8 times its sigma";
}

TEST(ConsistencyMonitor, FourOutliersInARowDoItThreeDoNot) {
  for (const double outlier :
       {1e3, -1e9, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    ConsistencyMonitor monitor;
    EXPECT_EQ(updates_until(monitor, true, 10, [=] { return Innovation(3, outlier); }), 4);
  }
}

TEST(ConsistencyMonitor, TheEstimatorsOwnDoubtCountsByItself) {
  ConsistencyMonitor monitor;
  monitor.distrust(true);
  monitor.observe(3, Innovation{1, 1, 1});
  EXPECT_TRUE(monitor.degraded());
  monitor.distrust(false);
  EXPECT_FALSE(monitor.degraded());
  monitor.distrust(true);
  monitor.reset();
  EXPECT_FALSE(monitor.degraded());
}

}  // namespace
}  // namespace canhil::target
