#include "bench/checks/histogram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace canhil::checks {
namespace {

struct Range {
  std::int64_t to_us;
  std::int64_t width_us;
};
constexpr std::array<Range, 4> ranges{{{10'000, 1}, {100'000, 10}, {1'000'000, 100}, {10'000'000, 1000}}};

std::size_t bucket_of(std::int64_t t_us) {
  std::int64_t first = 0, from_us = 0;
  for (const Range& range : ranges) {
    if (t_us < range.to_us) return static_cast<std::size_t>(first + (t_us - from_us) / range.width_us);
    first += (range.to_us - from_us) / range.width_us;
    from_us = range.to_us;
  }
  return static_cast<std::size_t>(first);
}

std::int64_t from_us_of(std::size_t bucket) {
  auto left = static_cast<std::int64_t>(bucket);
  std::int64_t from_us = 0;
  for (const Range& range : ranges) {
    const std::int64_t in_range = (range.to_us - from_us) / range.width_us;
    if (left < in_range) return from_us + left * range.width_us;
    left -= in_range;
    from_us = range.to_us;
  }
  return from_us;
}

}  // namespace

std::int64_t bucket_width_us(std::int64_t from_us) {
  const auto range =
      std::ranges::find_if(ranges, [&](const Range& candidate) { return from_us < candidate.to_us; });
  return range == ranges.end() ? 0 : range->width_us;
}

std::uint64_t nearest_rank(double q, std::uint64_t count) {
  return std::max<std::uint64_t>(static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count))), 1);
}

double bucket_middle_us(std::int64_t from_us) {
  return static_cast<double>(from_us) + 0.5 * static_cast<double>(bucket_width_us(from_us));
}

void Histogram::add(std::int64_t t_ns, std::uint64_t times) {
  min_ns_ = count_ == 0 ? t_ns : std::min(min_ns_, t_ns);
  max_ns_ = count_ == 0 ? t_ns : std::max(max_ns_, t_ns);
  count_ += times;
  const std::size_t bucket = bucket_of(std::max<std::int64_t>(t_ns, 0) / 1000);
  if (bucket >= counts_.size()) counts_.resize(bucket + 1);
  counts_[bucket] += times;
}

void Histogram::add(const Histogram& other) {
  if (other.count_ == 0) return;
  min_ns_ = count_ == 0 ? other.min_ns_ : std::min(min_ns_, other.min_ns_);
  max_ns_ = count_ == 0 ? other.max_ns_ : std::max(max_ns_, other.max_ns_);
  count_ += other.count_;
  counts_.resize(std::max(counts_.size(), other.counts_.size()));
  for (std::size_t bucket = 0; bucket < other.counts_.size(); ++bucket)
    counts_[bucket] += other.counts_[bucket];
}

double Histogram::quantile_ns(double q) const {
  if (count_ == 0) return 0;
  const std::uint64_t rank = nearest_rank(q, count_);
  if (rank >= count_) return static_cast<double>(max_ns_);
  std::uint64_t passed = 0;
  std::size_t bucket = 0;
  while ((passed += counts_[bucket]) < rank) ++bucket;
  return std::clamp(1e3 * bucket_middle_us(from_us_of(bucket)), static_cast<double>(min_ns_),
                    static_cast<double>(max_ns_));
}

std::uint64_t Histogram::count_above(double t_ns) const {
  std::uint64_t above = 0;
  for (std::size_t bucket = counts_.size(); bucket > 0; --bucket) {
    if (1e3 * bucket_middle_us(from_us_of(bucket - 1)) <= t_ns) break;
    above += counts_[bucket - 1];
  }
  return above;
}

std::vector<Histogram::Bucket> Histogram::buckets() const {
  std::vector<Bucket> filled;
  for (std::size_t bucket = 0; bucket < counts_.size(); ++bucket) {
    if (counts_[bucket] > 0) filled.push_back({from_us_of(bucket), counts_[bucket]});
  }
  return filled;
}

void TimeLine::add(std::int64_t t_ns, std::int64_t value_ns) {
  const std::int64_t at_ns = std::max<std::int64_t>(t_ns, 0);
  while (at_ns / stretch_ns_ >= static_cast<std::int64_t>(max_stretches)) {
    const std::size_t half = (largest_ns_.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i) {
      const std::size_t second = std::min(2 * i + 1, largest_ns_.size() - 1);
      largest_ns_[i] = std::max(largest_ns_[2 * i], largest_ns_[second]);
    }
    largest_ns_.resize(half);
    stretch_ns_ *= 2;
  }
  const auto stretch = static_cast<std::size_t>(at_ns / stretch_ns_);
  if (stretch >= largest_ns_.size()) largest_ns_.resize(stretch + 1, -1);
  largest_ns_[stretch] = std::max(largest_ns_[stretch], value_ns);
}

}  // namespace canhil::checks
