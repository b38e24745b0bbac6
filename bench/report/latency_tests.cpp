#include "bench/report/latency_tests.hpp"

#include <cmath>
#include <numeric>

#include "bench/checks/probability.hpp"

namespace canhil::report {
namespace {

// The number of values in the buckets after the given one.
double count_beyond(const Buckets& sample, std::int64_t from_us) {
  double beyond = 0;
  for (const auto& bucket : sample)
    if (bucket.from_us > from_us) beyond += static_cast<double>(bucket.count);
  return beyond;
}

double count_of(const Buckets& sample) { return count_beyond(sample, -1); }

// The bucket of the 99 % quantile, by nearest rank.
std::int64_t p99_bucket(const Buckets& sample) {
  double left = std::ceil(0.99 * count_of(sample));
  for (const auto& bucket : sample) {
    left -= static_cast<double>(bucket.count);
    if (left <= 0) return bucket.from_us;
  }
  return sample.empty() ? 0 : sample.back().from_us;
}

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double squares_about(std::span<const double> values, double mean) {
  return std::accumulate(values.begin(), values.end(), 0.0,
                         [mean](double sum, double v) { return sum + (v - mean) * (v - mean); });
}

}  // namespace

// U counts the pairs with b > a, and half of the pairs with b equal to a. The variance of U is
// m n / 12 (N + 1 - sum (t_k^3 - t_k) / (N (N - 1))),
// where m and n are the sizes of the two samples, N is the sum of m and n, and t_k is the number of values in
// bucket k.
RankTest rank_test(const Buckets& a, const Buckets& b) {
  const double m = count_of(a), n = count_of(b);
  if (m == 0 || n == 0) return {};
  double u = 0, passed_a = 0, ties = 0;
  auto in_a = a.begin();
  auto in_b = b.begin();
  while (in_a != a.end() || in_b != b.end()) {
    const bool from_a = in_a != a.end() && (in_b == b.end() || in_a->from_us <= in_b->from_us);
    const bool from_b = in_b != b.end() && (in_a == a.end() || in_b->from_us <= in_a->from_us);
    const double of_a = from_a ? static_cast<double>(in_a++->count) : 0;
    const double of_b = from_b ? static_cast<double>(in_b++->count) : 0;
    u += of_b * (passed_a + of_a / 2);
    passed_a += of_a;
    const double t = of_a + of_b;
    ties += t * t * t - t;
  }
  const double total = m + n;
  const double variance = m * n / 12 * (total + 1 - ties / (total * (total - 1)));
  if (!(variance > 0)) return {.effect = u / (m * n), .p = 1};
  return {.effect = u / (m * n), .p = checks::normal_above((u - m * n / 2 - 0.5) / std::sqrt(variance))};
}

ShareTest tail_test(const Buckets& a, const Buckets& b) {
  const double m = count_of(a), n = count_of(b);
  if (m == 0 || n == 0) return {};
  const std::int64_t bar_us = p99_bucket(a);
  return share_test(count_beyond(a, bar_us), m, count_beyond(b, bar_us), n);
}

ShareTest share_test(double k, double m, double l, double n) {
  if (m == 0 || n == 0) return {};
  ShareTest test{.share_a = k / m, .share_b = l / n};
  const double pooled = (test.share_a * m + test.share_b * n) / (m + n);
  const double variance = pooled * (1 - pooled) * (1 / m + 1 / n);
  if (variance > 0) test.p = checks::normal_above((test.share_b - test.share_a) / std::sqrt(variance));
  return test;
}

RunTest run_test(std::span<const double> a, std::span<const double> b, double resolution) {
  const auto m = static_cast<double>(a.size()), n = static_cast<double>(b.size());
  if (m < 1 || n < 1) return {};
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  RunTest test{.increase = mean_b - mean_a, .p = 1};
  const double freedom = m + n - 2;
  if (freedom < 1) return test;
  const double rounding = resolution * resolution / 12;
  const double variance = (squares_about(a, mean_a) + squares_about(b, mean_b)) / freedom + rounding;
  if (!(variance > 0)) {  // a difference without any scatter is certain
    test.p = test.increase > 0 ? 0 : 1;
    return test;
  }
  test.p = checks::student_t_above(freedom, test.increase / std::sqrt(variance * (1 / m + 1 / n)));
  return test;
}

}  // namespace canhil::report
