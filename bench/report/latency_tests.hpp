// Statistical tests for an increase: of latencies with one run per side, and of any number of a run with
// several runs per side.
#pragma once

#include <span>
#include <vector>

#include "bench/checks/histogram.hpp"

namespace canhil::report {

using Buckets = std::vector<checks::Histogram::Bucket>;

/// Mann-Whitney U test of two samples given as buckets; values in one bucket are ties.
struct RankTest {
  double effect = 0.5;  ///< P(b > a) + P(b = a) / 2: 0.5 if neither is larger, 1 if every b is larger
  double p =
      1;  ///< one-sided, null hypothesis: `b` is not larger; normal approximation with correction for ties
};
RankTest rank_test(const Buckets& a, const Buckets& b);

/// Test of two proportions: whether the share is larger in `b` than in `a`.
struct ShareTest {
  double share_a = 0, share_b = 0;
  double p = 1;  ///< one-sided, normal approximation with the pooled proportion
};
/// `k` of `m` on the side `a`, `l` of `n` on the side `b`.
ShareTest share_test(double k, double m, double l, double n);
/// Tests the shares that exceed the 99 % quantile of `a`.
ShareTest tail_test(const Buckets& a, const Buckets& b);

/// Student's t test of one number of each run, such as a quantile of its latencies: each run is one sample,
/// so the difference is compared with the scatter between runs.
struct RunTest {
  double increase = 0;  ///< mean of `b` minus mean of `a`
  double p = 1;  ///< one-sided, null hypothesis: `b` is not larger; p is 1 with one run per side, which shows
                 ///< no scatter
};
/// `resolution`: of the numbers; runs whose numbers are equal have at least the scatter of the rounding to
/// it.
RunTest run_test(std::span<const double> a, std::span<const double> b, double resolution);

}  // namespace canhil::report
