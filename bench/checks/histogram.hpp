// Distributions of durations, and their largest values over the course of the run, in bounded memory.
#pragma once

#include <cstdint>
#include <vector>

namespace canhil::checks {

/// Counts how often each duration occurs. The width of a bucket is 1 us for durations below 10 ms, 10 us for
/// durations below 100 ms, 100 us below 1 s, and 1 ms below 10 s. One more bucket counts all longer
/// durations. There are at most 37 001 buckets (296 kB); only the buckets up to the longest duration are
/// allocated. Minimum, maximum and count are exact.
class Histogram {
 public:
  /// A bucket that is not empty.
  struct Bucket {
    std::int64_t from_us = 0;
    std::uint64_t count = 0;
    friend bool operator==(const Bucket&, const Bucket&) = default;
  };

  /// Adds `times` to the count of a duration. A negative duration occurs if a clock was set; it counts in the
  /// first bucket.
  void add(std::int64_t t_ns, std::uint64_t times = 1);
  /// Adds all durations of another histogram.
  void add(const Histogram& other);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::int64_t min_ns() const { return min_ns_; }
  [[nodiscard]] std::int64_t max_ns() const { return max_ns_; }
  /// The quantile q in ns, by the nearest-rank method; q must be above 0 and at most 1. The result is the
  /// middle of the bucket that contains the rank, but neither less than the minimum nor more than the
  /// maximum. So the error is at most half a microsecond if the result is below 10 ms. Returns 0 if the
  /// histogram is empty.
  [[nodiscard]] double quantile_ns(double q) const;
  /// The number of durations above `t_ns`. Each counts as the middle of its bucket, as in quantile_ns().
  [[nodiscard]] std::uint64_t count_above(double t_ns) const;
  /// In ascending order.
  [[nodiscard]] std::vector<Bucket> buckets() const;

 private:
  std::vector<std::uint64_t> counts_;
  std::uint64_t count_ = 0;
  std::int64_t min_ns_ = 0;
  std::int64_t max_ns_ = 0;
};

/// The width [us] of the bucket that begins at `from_us`; 0 for the bucket of the durations above 10 s.
std::int64_t bucket_width_us(std::int64_t from_us);
/// The middle [us] of the bucket that begins at `from_us`.
double bucket_middle_us(std::int64_t from_us);

/// The rank of the quantile q, 0 < q <= 1, among `count` values in ascending order: nearest-rank method,
/// first rank 1.
std::uint64_t nearest_rank(double q, std::uint64_t count);

/// The largest value in each stretch of time. There are at most `max_stretches` stretches. When they no
/// longer cover the run, the length of every stretch doubles.
class TimeLine {
 public:
  static constexpr std::size_t max_stretches = 512;

  /// Values may come in any order of time; a time before 0 counts as 0.
  void add(std::int64_t t_ns, std::int64_t value_ns);

  [[nodiscard]] std::int64_t stretch_ns() const { return stretch_ns_; }
  /// The largest value of each stretch of time, beginning at time 0; -1 for a stretch without a value.
  [[nodiscard]] const std::vector<std::int64_t>& largest_ns() const { return largest_ns_; }

 private:
  std::int64_t stretch_ns_ = 10'000'000;
  std::vector<std::int64_t> largest_ns_;
};

}  // namespace canhil::checks
