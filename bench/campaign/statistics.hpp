// Statistics over the runs of a variant. A run is missing at a time if it ended earlier, if its last update
// is stale, or if its value is not finite. Missing runs are counted, never ignored: if a run is missing, no
// limit is met. paired_fraction() and divergence() instead count a missing run as the worst one.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bench/campaign/series.hpp"

namespace canhil::campaign {

/// All runs at one update time.
struct CurvePoint {
  std::int64_t t_us = 0;
  double rms = 0;  ///< RMS of the finite values [SI]; NaN: no finite value
  double rms_error = std::numeric_limits<double>::quiet_NaN();  ///< of `rms`; NaN: too few runs, or rms 0
  std::size_t runs = 0;                                         ///< number of finite values
  std::size_t missing = 0;                                      ///< runs without a finite value
};

/// Root mean square of a quantity over the runs, at every update time of any run, ascending. Each run
/// contributes its last update at or before that time, so a lost update leaves the previous one.
std::vector<CurvePoint> rms_curve(std::span<const RunSeries> runs, const Quantity& quantity);

/// The last point at or before a time; none: the curve begins later.
std::optional<CurvePoint> value_at(std::span<const CurvePoint> curve, std::int64_t t_us);

/// First update time [s] from which the RMS stays at or below a threshold (SI) to the end, with no run
/// missing; none: never.
std::optional<double> time_within(std::span<const CurvePoint> curve, double threshold);

/// The distribution of a magnitude over the runs at a time. Each run contributes its last update up to that
/// time. A run is missing if it had ended earlier, if this update is stale, or if its value is not finite.
struct RunDistribution {
  double rms = 0, mean = 0;          ///< over the finite values [SI]
  double median = 0;                 ///< for an even number: the mean of the middle two
  double p90 = 0;                    ///< by nearest rank
  double below = 0;                  ///< fraction of all runs below a bound
  double rms_low = 0, rms_high = 0;  ///< 5 % and 95 % quantile of the RMS of `batch` runs
  std::size_t batch = 0;             ///< as requested, or all runs if there are fewer
  std::size_t missing = 0;
};
/// `batch`: number of runs drawn with replacement for each of 2000 bootstrap samples (Efron, Tibshirani
/// (1993), chapter 6), from a fixed seed, so that results are reproducible.
RunDistribution run_distribution(std::span<const RunSeries> runs, const Quantity& quantity, std::int64_t t_us,
                                 double bound, std::size_t batch);

/// Mean and standard deviation of the signed quantity over all runs and updates of a window, ends included.
struct WindowStatistics {
  double mean = 0;
  double standard_deviation = 0;  ///< about the mean, with n - 1
  std::size_t count = 0;          ///< finite values
  std::size_t missing = 0;        ///< values not finite, or absent because a run had ended or become silent
};
WindowStatistics window_statistics(std::span<const RunSeries> runs, const Quantity& quantity,
                                   std::int64_t from_us, std::int64_t to_us);

/// The mean of |quantity| over a window of each run, and the distribution of these means over the runs.
struct RunMeans {
  double mean = 0;
  double standard_deviation = 0;  ///< with n - 1
  double largest = 0;
  std::size_t missing = 0;  ///< runs that ended early, were silent in the window, or had a value not finite
};
RunMeans run_means(std::span<const RunSeries> runs, const Quantity& quantity, std::int64_t from_us,
                   std::int64_t to_us);

/// RMS and mean over all runs and samples within a window of the time to go [s]; the samples are by time to
/// go.
struct ToGoStatistics {
  double rms = 0, mean = 0;  ///< of the finite values [SI]
  std::size_t count = 0;     ///< finite values
  std::size_t missing = 0;   ///< runs that ended early or have too few finite values in the window
};
ToGoStatistics to_go_statistics(std::span<const RunSeries> runs, const Quantity& quantity, double least,
                                double most);

/// The fraction of pairs of runs with the same random numbers in which one variant is better.
struct PairedFraction {
  std::size_t better = 0;  ///< runs with |quantity| of `a` < that of `b`; a missing value counts as the worst
  std::size_t pairs = 0;
  double fraction = 0;
  double low = 0, high = 0;  ///< Clopper-Pearson interval of the probability
};
/// Compares at the last update at or before a time. `a` and `b`: ordered by run. A run without a counterpart
/// does not count. Confidence in (0, 1).
PairedFraction paired_fraction(std::span<const RunSeries> a, std::span<const RunSeries> b,
                               const Quantity& quantity, std::int64_t t_us, double confidence);

/// Tests normalised errors squared against chi-square over a window. Errors within one run are correlated in
/// time, so the bounds apply to the mean over runs at one update (Bar-Shalom, Li, Kirubarajan (2001), section
/// 5.4.2).
struct ConsistencyStatistics {
  double mean = 0;           ///< over all runs and updates
  double low = 0, high = 0;  ///< central interval of chi2(k n) / n, n: runs, k: degrees of freedom
  double inside = 0;         ///< fraction of the updates whose mean over runs lies in the interval
  std::size_t updates = 0;
  std::size_t missing = 0;
};
/// `quantity` has degrees of freedom. Probability in (0, 1).
ConsistencyStatistics consistency(std::span<const RunSeries> runs, const Quantity& quantity,
                                  std::int64_t from_us, std::int64_t to_us, double probability);

/// Runs that ended early, or whose |quantity| at their last update is above a bound (SI) or not finite.
struct Divergence {
  std::size_t faulted = 0;
  std::size_t beyond = 0;  ///< of the completed runs
  std::size_t runs = 0;
  double largest = 0;  ///< the largest |quantity| of the completed runs
};
/// With `from_us`, all samples from this time on are judged; without it, only the last update.
Divergence divergence(std::span<const RunSeries> runs, const Quantity& quantity, double bound,
                      std::optional<std::int64_t> from_us = std::nullopt);

}  // namespace canhil::campaign
