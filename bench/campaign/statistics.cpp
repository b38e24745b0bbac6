#include "bench/campaign/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "bench/campaign/seconds.hpp"
#include "bench/campaign/updates.hpp"
#include "bench/checks/probability.hpp"
#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"
#include "bench/world/stream.hpp"

namespace canhil::campaign {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Variance about the mean, with divisor n - 1; NaN for fewer than two values.
double variance(const std::vector<double>& values, double mean) {
  if (values.size() < 2) return nan;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / static_cast<double>(values.size() - 1);
}

// Standard error of the RMS, computed from the scatter of the squares. The RMS is the square root of the mean
// of the squares, so its error is the error of this mean divided by twice the RMS.
double standard_error_of_rms(const std::vector<double>& squares, double mean) {
  if (mean <= 0) return nan;
  return std::sqrt(variance(squares, mean) / static_cast<double>(squares.size())) / (2 * std::sqrt(mean));
}

}  // namespace

std::vector<CurvePoint> rms_curve(std::span<const RunSeries> runs, const Quantity& quantity) {
  std::vector<CurvePoint> curve;
  for (const std::int64_t t_us : update_times(runs, quantity)) {
    CurvePoint point{.t_us = t_us};
    std::vector<double> squares;
    for (const RunSeries& run : runs) {
      const double value = last_value(run, quantity, t_us);
      if (!std::isnan(value)) squares.push_back(value * value);
    }
    point.runs = squares.size();
    point.missing = runs.size() - point.runs;
    if (squares.empty()) {
      point.rms = nan;
    } else {
      const double mean = sum_of(squares) / static_cast<double>(point.runs);
      point.rms = std::sqrt(mean);
      point.rms_error = standard_error_of_rms(squares, mean);
    }
    curve.push_back(point);
  }
  return curve;
}

std::optional<CurvePoint> value_at(std::span<const CurvePoint> curve, std::int64_t t_us) {
  const auto after = std::ranges::upper_bound(curve, t_us, {}, &CurvePoint::t_us);
  if (after == curve.begin()) return std::nullopt;
  return *std::prev(after);
}

std::optional<double> time_within(std::span<const CurvePoint> curve, double threshold) {
  const auto outside = std::find_if(curve.rbegin(), curve.rend(), [&](const CurvePoint& point) {
    return point.missing > 0 || !(point.rms <= threshold);  // NaN is outside
  });
  if (outside == curve.rbegin()) return std::nullopt;  // outside at the end, or the curve is empty
  return seconds(outside.base()->t_us);
}

RunDistribution run_distribution(std::span<const RunSeries> runs, const Quantity& quantity, std::int64_t t_us,
                                 double bound, std::size_t batch) {
  constexpr std::size_t resamples = 2000;
  std::vector<double> values;
  for (const RunSeries& run : runs) {
    const double value = last_magnitude(run, quantity, t_us);
    if (!std::isnan(value)) values.push_back(value);
  }
  RunDistribution found{.batch = std::min(batch, runs.size()), .missing = runs.size() - values.size()};
  if (values.empty()) {
    found.rms = found.mean = found.median = found.p90 = found.rms_low = found.rms_high = nan;
    return found;
  }
  const auto n = static_cast<double>(values.size());
  found.mean = sum_of(values) / n;
  found.rms = std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / n);
  found.median = checks::median(values);
  found.p90 = checks::quantile(values, 0.9);
  const auto inside = std::ranges::count_if(values, [&](double value) { return value < bound; });
  found.below = static_cast<double>(inside) / static_cast<double>(runs.size());
  world::Stream stream(1, 0, "bootstrap");
  std::vector<double> resampled(resamples);
  for (double& rms : resampled) {
    double sum_of_batch = 0;
    for (std::size_t i = 0; i < found.batch; ++i) {
      const double value = values[static_cast<std::size_t>(stream.uniform() * n)];
      sum_of_batch += value * value;
    }
    rms = std::sqrt(sum_of_batch / static_cast<double>(found.batch));
  }
  found.rms_low = checks::quantile(resampled, 0.05);
  found.rms_high = checks::quantile(resampled, 0.95);
  return found;
}

WindowStatistics window_statistics(std::span<const RunSeries> runs, const Quantity& quantity,
                                   std::int64_t from_us, std::int64_t to_us) {
  std::vector<double> values;
  WindowStatistics statistics;
  for (const std::int64_t t_us : update_times(runs, from_us, to_us)) {
    for (const RunSeries& run : runs) {
      const double value = value_at(run, quantity, t_us);
      if (!std::isnan(value)) {
        values.push_back(value);
      } else if (!may_be_missing(run, quantity, t_us, from_us)) {
        ++statistics.missing;
      }
    }
  }
  statistics.count = values.size();
  statistics.mean = values.empty() ? nan : sum_of(values) / static_cast<double>(values.size());
  statistics.standard_deviation = std::sqrt(variance(values, statistics.mean));
  return statistics;
}

RunMeans run_means(std::span<const RunSeries> runs, const Quantity& quantity, std::int64_t from_us,
                   std::int64_t to_us) {
  std::vector<double> means;
  for (const RunSeries& run : runs) {
    const auto times = run.samples.times();
    const auto from = std::ranges::lower_bound(times, from_us) - times.begin();
    const auto to = std::ranges::upper_bound(times, to_us) - times.begin();
    double sum = 0;
    for (auto i = from; i < to; ++i)
      sum += std::abs(run.samples.value(static_cast<std::size_t>(i), quantity));
    const double mean = sum / static_cast<double>(to - from);  // NaN if the window has no sample
    const bool completed = run.ending.kind == drive::Ending::Kind::completed;
    if (completed && std::isfinite(mean) && answers_throughout(run, from_us, to_us)) means.push_back(mean);
  }
  RunMeans found{.missing = runs.size() - means.size()};
  if (means.empty()) {
    found.mean = found.standard_deviation = found.largest = nan;
    return found;
  }
  const auto n = static_cast<double>(means.size());
  for (const double mean : means) found.mean += mean / n;
  found.standard_deviation = std::sqrt(variance(means, found.mean));
  found.largest = *std::ranges::max_element(means);
  return found;
}

ToGoStatistics to_go_statistics(std::span<const RunSeries> runs, const Quantity& quantity, double least,
                                double most) {
  ToGoStatistics statistics;
  double sum = 0, squares = 0;
  for (const RunSeries& run : runs) {
    const std::size_t before = statistics.count;
    const double stretch = seconds(run.samples.layout().to_go_stretch_us);
    for (std::size_t i = 0; i < run.samples.size(); ++i) {
      const double begins = -seconds(run.samples.times()[i]);
      constexpr double rounding = 1e-9;
      if (begins < least + stretch - rounding || begins > most + rounding) continue;
      const double value = run.samples.value(i, quantity);
      if (!std::isfinite(value)) continue;
      sum += value;
      squares += value * value;
      ++statistics.count;
    }
    const bool ended = run.ending.kind != drive::Ending::Kind::completed;
    const auto answered = static_cast<double>(statistics.count - before);
    const bool silent = answered == 0 || answered < checks::least_answered *
                                                        std::floor(samples_to_go(run.freshness, least, most));
    statistics.missing += ended || silent ? 1 : 0;
  }
  const auto n = static_cast<double>(statistics.count);
  statistics.mean = statistics.count == 0 ? nan : sum / n;
  statistics.rms = statistics.count == 0 ? nan : std::sqrt(squares / n);
  return statistics;
}

PairedFraction paired_fraction(std::span<const RunSeries> a, std::span<const RunSeries> b,
                               const Quantity& quantity, std::int64_t t_us, double confidence) {
  const auto magnitude = [&](const RunSeries& run) {
    const double value = last_magnitude(run, quantity, t_us);
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  };
  PairedFraction paired;
  for (const RunSeries& run : a) {
    const auto other = std::ranges::lower_bound(b, run.run, {}, &RunSeries::run);
    if (other == b.end() || other->run != run.run) continue;
    ++paired.pairs;
    if (magnitude(run) < magnitude(*other)) ++paired.better;
  }
  if (paired.pairs == 0) return {.fraction = nan, .low = 0, .high = 1};
  const auto pairs = static_cast<double>(paired.pairs), better = static_cast<double>(paired.better);
  const double tail = (1 - confidence) / 2;
  paired.fraction = better / pairs;
  const auto [low, high] = checks::success_bounds(pairs, better, tail);
  paired.low = low;
  paired.high = high;
  return paired;
}

ConsistencyStatistics consistency(std::span<const RunSeries> runs, const Quantity& quantity,
                                  std::int64_t from_us, std::int64_t to_us, double probability) {
  ConsistencyStatistics statistics;
  if (runs.empty()) return {.mean = nan};
  // Central chi-square intervals of the mean, by number of runs.
  std::map<std::size_t, checks::MeanBounds> intervals;
  const auto interval_of = [&](std::size_t some) {
    const auto [place, is_new] = intervals.try_emplace(some);
    if (is_new)
      place->second = checks::mean_of_squares_bounds(static_cast<double>(some), quantity.degrees_of_freedom,
                                                     (1 - probability) / 2);
    return place->second;
  };
  const auto of_all = interval_of(runs.size());
  statistics.low = of_all.low;
  statistics.high = of_all.high;
  double sum = 0;
  std::size_t count = 0, inside = 0;
  for (const std::int64_t t_us : update_times(runs, from_us, to_us)) {
    double sum_here = 0;
    std::size_t here = 0, not_asked = 0;
    for (const RunSeries& run : runs) {
      if (may_be_missing(run, quantity, t_us, from_us)) {
        ++not_asked;
        continue;
      }
      const double value = value_at(run, quantity, t_us);
      if (std::isnan(value)) continue;
      sum_here += value;
      ++here;
    }
    const std::size_t asked = runs.size() - not_asked;
    if (asked == 0) continue;
    ++statistics.updates;
    statistics.missing += asked - here;
    const auto [low, high] = interval_of(asked);
    const double mean = sum_here / static_cast<double>(asked);
    if (here == asked && mean >= low && mean <= high) ++inside;
    sum += sum_here;
    count += here;
  }
  statistics.mean = count == 0 ? nan : sum / static_cast<double>(count);
  statistics.inside =
      statistics.updates == 0 ? nan : static_cast<double>(inside) / static_cast<double>(statistics.updates);
  return statistics;
}

}  // namespace canhil::campaign
