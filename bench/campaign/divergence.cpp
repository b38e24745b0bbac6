#include "bench/campaign/divergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/campaign/updates.hpp"

namespace canhil::campaign {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::size_t index_from(const RunSeries& run, std::int64_t from_us) {
  const auto times = run.samples.times();
  return static_cast<std::size_t>(std::ranges::lower_bound(times, from_us) - times.begin());
}

// The largest |quantity| of the samples from `from_us` on. NaN if a value is NaN or if there is no sample.
double largest_magnitude(const RunSeries& run, const Quantity& quantity, std::int64_t from_us) {
  const std::size_t from = index_from(run, from_us), size = run.samples.size();
  double largest = from == size ? no_value : 0;
  for (std::size_t i = from; i < size; ++i) {
    const double magnitude = std::abs(run.samples.value(i, quantity));
    if (!(magnitude <= largest)) largest = magnitude;
    if (std::isnan(largest)) break;
  }
  return largest;
}

// The time of the first sample from `from_us` on with a |quantity| above the bound or without one.
std::optional<std::int64_t> first_above(const RunSeries& run, const Quantity& quantity, double bound,
                                        std::int64_t from_us) {
  for (std::size_t i = index_from(run, from_us); i < run.samples.size(); ++i)
    if (!(std::abs(run.samples.value(i, quantity)) <= bound)) return run.samples.times()[i];
  return std::nullopt;
}

// Whether a NEES or NIS is infinite, from `from_us` on or else in the last sample: the sigmas of such an
// answer are no numbers.
bool has_infinite_statistic(const RunSeries& run, std::optional<std::int64_t> from_us) {
  const std::size_t size = run.samples.size();
  const std::size_t last = size == 0 ? 0 : size - 1;
  const std::size_t from = from_us ? index_from(run, *from_us) : last;
  return std::ranges::any_of(run.samples.layout().kept, [&](const Quantity* one) {
    if (one->degrees_of_freedom == 0) return false;
    for (std::size_t i = from; i < size; ++i)
      if (std::isinf(run.samples.value(i, *one))) return true;
    return false;
  });
}

// Judges what follows later than `allowed_us` in a run: whether it is still above the bound, or unknown.
// Nothing: the run ends before that.
std::optional<bool> above_after(const RunSeries& run, const Quantity& quantity, double bound,
                                std::int64_t allowed_us) {
  if (allowed_us < run.samples.times().back())
    return !(largest_magnitude(run, quantity, allowed_us + 1) <= bound);
  if (silent_at_end(run) && allowed_us < end_of(run)) return true;
  return std::nullopt;
}

}  // namespace

Divergence divergence(std::span<const RunSeries> runs, const Quantity& quantity, double bound,
                      std::optional<std::int64_t> from_us, std::optional<std::int64_t> within_us) {
  constexpr std::int64_t at_the_end = std::numeric_limits<std::int64_t>::max();
  const Quantity& of_every = quantity.of_every_answer == nullptr ? quantity : *quantity.of_every_answer;
  Divergence result{.runs = runs.size()};
  for (const RunSeries& run : runs) {
    if (run.ending.kind != drive::Ending::Kind::completed) {
      ++result.faulted;
      continue;
    }
    const double magnitude =
        from_us ? largest_magnitude(run, quantity, *from_us) : last_magnitude(run, quantity, at_the_end);
    if (!std::isnan(result.largest) && !(magnitude <= result.largest)) result.largest = magnitude;
    bool beyond = !(magnitude <= bound);
    if (within_us && std::isfinite(magnitude)) {
      beyond = false;
      if (const auto first_us = first_above(run, of_every, bound, *from_us)) {
        ++result.ever_above;
        const auto above = above_after(run, quantity, bound, *first_us + *within_us);
        if (!above) ++result.too_late;
        beyond = above.value_or(false);
      }
    }
    if (beyond || has_infinite_statistic(run, from_us)) ++result.beyond;
  }
  return result;
}

}  // namespace canhil::campaign
