// Latencies that are drawn at random, for tests of comparisons.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "bench/report/latency_tests.hpp"

namespace canhil::report {

inline Buckets buckets_of(const std::vector<int>& sample_us) {
  std::map<int, std::uint64_t> counts;
  for (const int us : sample_us) ++counts[us];
  Buckets buckets;
  for (const auto& [us, count] : counts) buckets.push_back({us, count});
  return buckets;
}

inline std::vector<int> latencies_us(unsigned seed, double median_us, std::size_t count = 2000,
                                     double tail_share = 0) {
  std::mt19937 random(seed);
  std::lognormal_distribution<double> body(std::log(median_us), 0.1);
  std::bernoulli_distribution late(tail_share);
  std::vector<int> sample(count);
  std::ranges::generate(sample, [&] { return static_cast<int>(body(random)) * (late(random) ? 4 : 1); });
  return sample;
}

}  // namespace canhil::report
