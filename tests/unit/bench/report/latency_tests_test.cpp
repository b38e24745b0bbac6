#include "bench/report/latency_tests.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/unit/bench/report/drawn_latencies.hpp"

namespace canhil::report {
namespace {

// The effect from the definition of U, which compares all pairs.
double effect_by_pairs(const std::vector<int>& a, const std::vector<int>& b) {
  double u = 0;
  for (const int of_b : b)
    for (const int of_a : a) u += of_b > of_a ? 1 : of_b == of_a ? 0.5 : 0;
  return u / static_cast<double>(a.size() * b.size());
}

TEST(RankTest, IsThatOfAllPairs) {
  const auto a = latencies_us(1, 30, 300), b = latencies_us(2, 31, 200);
  EXPECT_NEAR(rank_test(buckets_of(a), buckets_of(b)).effect, effect_by_pairs(a, b), 1e-12);
}

// Computed by hand for the samples a = {1, 2, 2} and b = {2, 3, 3, 1}, which form 12 pairs. The four values
// of b are greater than a in 1, 3, 3 and 0 pairs, in total in 7 pairs. In 3 pairs, both values are equal;
// each of these pairs counts as a half. So U is 7 + 1.5. Among all N = 7 values, the value 1 occurs twice, 2
// three times, and 3 twice. The sum of t^3 - t over these counts t is 6 + 24 + 6 = 36, so the variance is
// 12/12 * (8 - 36/42) = 7.142857. Then z is (8.5 - 6 - 0.5) / 2.672612 = 0.748331, and P(Z > z) is 0.227130.
TEST(RankTest, HandComputedWithTies) {
  const RankTest test = rank_test(buckets_of({1, 2, 2}), buckets_of({2, 3, 3, 1}));
  EXPECT_NEAR(test.effect, 8.5 / 12, 1e-12);
  EXPECT_NEAR(test.p, 0.227130, 2e-5);
}

TEST(RankTest, EqualSamplesAndEmptyOnesSayNothing) {
  EXPECT_EQ(rank_test(buckets_of({5, 5, 5}), buckets_of({5, 5})).effect, 0.5);
  EXPECT_EQ(rank_test(buckets_of({5, 5, 5}), buckets_of({5, 5})).p, 1);
  EXPECT_EQ(rank_test({}, buckets_of({5})).p, 1);
}

TEST(RankTest, FalseAlarmsAreAsRareAsPSays) {
  int alarms = 0;
  for (unsigned i = 0; i < 400; ++i) {
    const auto test = rank_test(buckets_of(latencies_us(2 * i + 10, 200, 400)),
                                buckets_of(latencies_us(2 * i + 11, 200, 400)));
    alarms += test.p < 0.05 ? 1 : 0;
  }
  EXPECT_GT(alarms, 5);  // binomial of 400 and 0.05: 20 +- 4.4
  EXPECT_LT(alarms, 36);
}

TEST(TailTest, SharesBeyondTheFirstP99) {
  std::vector<int> a(99, 10), b(90, 10);
  a.push_back(50);
  b.insert(b.end(), 10, 40);
  const ShareTest test = tail_test(buckets_of(a), buckets_of(b));
  EXPECT_NEAR(test.share_a, 0.01, 1e-12);
  EXPECT_NEAR(test.share_b, 0.10, 1e-12);
  EXPECT_LT(test.p, 0.01);
}

TEST(RunTest, WithoutScatterOrResolutionADifferenceIsCertain) {
  const std::array<double, 2> a{1, 1}, b{2, 2};
  EXPECT_EQ(run_test(a, b, 0).p, 0);
  EXPECT_EQ(run_test(b, a, 0).p, 1);
  EXPECT_EQ(run_test(a, a, 0).p, 1);
  EXPECT_GT(run_test(a, b, 1).p, 0) << "rounded to 1, they may scatter";
}

}  // namespace
}  // namespace canhil::report
