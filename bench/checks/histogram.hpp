// Distributions of durations, and their largest values over the course of the run, in bounded memory.
#pragma once

#include <cstdint>
#include <vector>

namespace canhil::checks {

/// Counts how often each duration occurs, in buckets: buckets of 1 us below 10 ms, of 10 us below 100 ms, of
/// 100 us below 1 s, of 1 ms below 10 s, and one bucket for all longer durations. At most 37 001 buckets (296
/// kB); only the buckets up to the longest duration are allocated. Minimum, maximum and count are exact.
class Histogram {
 public:
  /// A bucket that is not empty.
  struct Bucket {
    std::int64_t from_us = 0;
    std::uint64_t count = 0;
    friend bool operator==(const Bucket&, const Bucket&) = default;
  };

  /// Counts a duration `times` times. A negative duration (because a clock was set) counts in the first
  /// bucket.
  void add(std::int64_t t_ns, std::uint64_t times = 1);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::int64_t min_ns() const { return min_ns_; }
  [[nodiscard]] std::int64_t max_ns() const { return max_ns_; }
  /// The quantile q by nearest rank [ns], 0 < q <= 1. The result is the middle of the bucket that contains
  /// this rank, limited to the minimum and maximum. So a quantile below 10 ms is off by at most half a
  /// microsecond. 0 if the histogram is empty.
  [[nodiscard]] double quantile_ns(double q) const;
  /// In ascending order.
  [[nodiscard]] std::vector<Bucket> buckets() const;

 private:
  std::vector<std::uint64_t> counts_;
  std::uint64_t count_ = 0;
  std::int64_t min_ns_ = 0;
  std::int64_t max_ns_ = 0;
};

/// Width [us] of the bucket that begins at a time; 0 for the bucket above 10 s.
std::int64_t bucket_width_us(std::int64_t from_us);

/// The largest value in each stretch of time. When the fixed number of stretches no longer covers the run,
/// the length of each stretch doubles.
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
