// Whether latencies became later: within one run a side, and from run to run.
#pragma once

#include <span>
#include <vector>

#include "bench/checks/histogram.hpp"

namespace canhil::report {

using Buckets = std::vector<checks::Histogram::Bucket>;

/// Mann-Whitney U test of two samples that are known by their buckets; those of one bucket are ties.
struct RankTest {
  double effect = 0.5;  ///< P(b > a) + P(b = a) / 2: 0.5 if neither is larger, 1 if every b is
  double p = 1;         ///< one-sided, that `b` is no larger: normal approximation with correction for ties
};
RankTest rank_test(const Buckets& a, const Buckets& b);

/// Whether more of `b` than of `a` is slower than the 99 % quantile of `a`: two proportions.
struct TailTest {
  double share_a = 0, share_b = 0;
  double p = 1;  ///< one-sided, normal approximation of the pooled difference
};
TailTest tail_test(const Buckets& a, const Buckets& b);

/// Student's t test of one quantile of each run [us]: the run is the sample, so what differs from run to run
/// is the scatter that a difference is held against.
struct RunTest {
  double later_us = 0;  ///< mean of `b` less mean of `a`
  double p = 1;         ///< one-sided, that `b` is no later; 1 of one run a side, which shows no scatter
};
RunTest run_test(std::span<const double> a_us, std::span<const double> b_us);

}  // namespace canhil::report
