// What got worse from one run of a scenario to another.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/checks/histogram.hpp"
#include "dbc/wire/result.hpp"

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

/// What must hold, all of it, for a latency to count as worse.
struct Bars {
  double p = 0.01;        ///< of a test, divided by the number of tests
  double effect = 0.64;   ///< at least: a 'medium' one of Vargha and Delaney (2000)
  double tail_times = 2;  ///< so many times as many beyond the 99 % quantile
  double least_us = 2;    ///< p50, or p99, later by more than two stamps differ
};

enum class Comparison : std::uint8_t { no_worse, worse, not_comparable };

struct Compared {
  Comparison outcome = Comparison::no_worse;
  std::string text;  ///< a line for each thing compared, the last one the outcome
};

/// Compares reports as document() makes them, `b` against `a`. Error: one line, what a report lacks.
Result<Compared> compare(const nlohmann::ordered_json& a, const nlohmann::ordered_json& b,
                         const Bars& bars = {});

}  // namespace canhil::report
