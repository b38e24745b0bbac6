#include "bench/checks/histogram.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace canhil::checks {
namespace {

using testing::ElementsAre;

using Bucket = Histogram::Bucket;

TEST(Histogram, IsEmptyAtFirst) {
  EXPECT_EQ(Histogram().count(), 0U);
  EXPECT_EQ(Histogram().quantile_ns(0.5), 0);
  EXPECT_THAT(Histogram().buckets(), ElementsAre());
}

TEST(Histogram, HasBucketsOfOneMicrosecondBelow10msAndCoarserOnesAbove) {
  Histogram histogram;
  for (const std::int64_t ns : {0, 999, 1'000, 9'999'999, 10'000'000, 10'009'999, 99'999'999, 100'000'000,
                                999'999'999, 1'000'000'000}) {
    histogram.add(ns);
  }
  histogram.add(9'999'999'999);
  histogram.add(3'600'000'000'000);
  EXPECT_THAT(histogram.buckets(),
              ElementsAre(Bucket{0, 2}, Bucket{1, 1}, Bucket{9'999, 1}, Bucket{10'000, 2}, Bucket{99'990, 1},
                          Bucket{100'000, 1}, Bucket{999'900, 1}, Bucket{1'000'000, 1}, Bucket{9'999'000, 1},
                          Bucket{10'000'000, 1}));
  EXPECT_EQ(bucket_width_us(9'999), 1);
  EXPECT_EQ(bucket_width_us(10'000), 10);
  EXPECT_EQ(bucket_width_us(100'000), 100);
  EXPECT_EQ(bucket_width_us(1'000'000), 1'000);
  EXPECT_EQ(bucket_width_us(10'000'000), 0);
}

TEST(Histogram, KnowsTheExtremesExactly) {
  Histogram histogram;
  histogram.add(123'456'789);
  EXPECT_EQ(histogram.quantile_ns(0.001), 123'456'789) << "no quantile is beyond what was measured";
  EXPECT_EQ(histogram.quantile_ns(1), 123'456'789);
  histogram.add(-5'000);
  EXPECT_EQ(histogram.min_ns(), -5'000);
  EXPECT_EQ(histogram.max_ns(), 123'456'789);
  EXPECT_THAT(histogram.buckets(), ElementsAre(Bucket{0, 1}, Bucket{123'400, 1}));
}

TEST(Histogram, CountsTheDurationsAboveALimit) {
  Histogram histogram;
  histogram.add(1'000'000, 3);
  histogram.add(2'000'000, 2);
  histogram.add(20'000'000);
  EXPECT_EQ(histogram.count_above(0), 6U);
  EXPECT_EQ(histogram.count_above(1'000'600), 3U) << "the middle of the bucket is 1000.5 us";
  EXPECT_EQ(histogram.count_above(2'001'000), 1U);
  EXPECT_EQ(histogram.count_above(1e12), 0U);
}

TEST(Histogram, QuantilesAreThoseOfTheSampleWithinHalfAMicrosecond) {
  std::mt19937_64 random(5);
  std::lognormal_distribution<double> late(std::log(200'000), 0.7);
  Histogram histogram;
  std::vector<std::int64_t> sample;
  for (int i = 0; i < 20'000; ++i) {
    sample.push_back(std::min<std::int64_t>(std::llround(late(random)), 9'999'999));
    histogram.add(sample.back());
  }
  std::ranges::sort(sample);
  for (const double q : {0.001, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(sample.size())));
    EXPECT_NEAR(histogram.quantile_ns(q), static_cast<double>(sample[rank - 1]), 500) << q;
  }
}

TEST(TimeLine, KeepsTheLargestOfEachStretch) {
  TimeLine line;
  line.add(0, 5);
  line.add(9'999'999, 7);
  line.add(9'999'998, 6);
  line.add(30'000'000, 1);
  EXPECT_EQ(line.stretch_ns(), 10'000'000);
  EXPECT_THAT(line.largest_ns(), ElementsAre(7, -1, -1, 1));
}

TEST(TimeLine, ADayTakesNoMoreMemoryAndLosesNoPeak) {
  TimeLine line;
  constexpr std::int64_t day_s = 86'400;
  for (std::int64_t s = 0; s < day_s; ++s) line.add(s * 1'000'000'000, s == 30'000 ? 99 : 3);
  EXPECT_LE(line.largest_ns().size(), TimeLine::max_stretches);
  EXPECT_GT(line.largest_ns().size(), TimeLine::max_stretches / 2 - 1);
  const auto peak = std::ranges::find(line.largest_ns(), 99);
  ASSERT_NE(peak, line.largest_ns().end());
  EXPECT_EQ(peak - line.largest_ns().begin(), 30'000 * std::int64_t{1'000'000'000} / line.stretch_ns());
  EXPECT_EQ(std::ranges::count(line.largest_ns(), 3),
            static_cast<std::ptrdiff_t>(line.largest_ns().size()) - 1);
}

}  // namespace
}  // namespace canhil::checks
