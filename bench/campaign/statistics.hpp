// Statistics over the runs of a variant. A run is missing at a time if it ended earlier, if its last update
// is stale, or if its value is not finite. Missing runs are counted, never ignored: if a run is missing, no
// limit is met. paired_fraction() and divergence() instead count a missing run as the worst run.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bench/campaign/series.hpp"

namespace canhil::campaign {

/// Statistics of all runs at one update time.
struct CurvePoint {
  std::int64_t t_us = 0;
  double rms = 0;  ///< RMS of the finite values [SI]; NaN: no finite value
  double rms_error = std::numeric_limits<double>::quiet_NaN();  ///< standard error of `rms`; NaN: unknown
  std::size_t runs = 0;                                         ///< number of finite values
  std::size_t missing = 0;                                      ///< runs without a finite value
};

/// Root mean square of a quantity over the runs. The curve has one point for each time that update_times()
/// returns, in ascending order. Each run contributes its last update at or before that time; if an update is
/// lost, the previous update is used.
std::vector<CurvePoint> rms_curve(std::span<const RunSeries> runs, const Quantity& quantity);

/// The last point at or before `t_us`; nullopt if the curve begins later.
std::optional<CurvePoint> value_at(std::span<const CurvePoint> curve, std::int64_t t_us);

/// The first update time [s] from which the RMS stays at or below a threshold (SI) to the end, with no run
/// missing. Returns nullopt if there is no such time.
std::optional<double> time_within(std::span<const CurvePoint> curve, double threshold);

/// The distribution of a magnitude over the runs at a time. Each run contributes its last update up to that
/// time. A run is missing if it had ended earlier, if this update is stale, or if its value is not finite.
struct RunDistribution {
  double rms = 0, mean = 0;          ///< over the finite values [SI]
  double median = 0;                 ///< for an even number of values: the mean of the middle two values
  double p90 = 0;                    ///< by nearest rank
  double below = 0;                  ///< fraction of all runs below a bound
  double rms_low = 0, rms_high = 0;  ///< 5 % and 95 % quantile of the RMS of `batch` runs
  std::size_t batch = 0;             ///< as requested, or the number of all runs if that is smaller
  std::size_t missing = 0;
};
/// `batch`: number of runs in each of 2000 bootstrap samples (Efron, Tibshirani (1993), chapter 6). The runs
/// of a sample are drawn with replacement, from a fixed seed, so that results are reproducible.
RunDistribution run_distribution(std::span<const RunSeries> runs, const Quantity& quantity, std::int64_t t_us,
                                 double bound, std::size_t batch);

/// Mean and standard deviation of the signed quantity over all runs and updates of a window, ends included.
struct WindowStatistics {
  double mean = 0;
  double standard_deviation = 0;  ///< about the mean, with divisor n - 1
  std::size_t count = 0;          ///< number of finite values
  std::size_t missing = 0;        ///< values that are not finite or absent: the run had ended or was silent
};
WindowStatistics window_statistics(std::span<const RunSeries> runs, const Quantity& quantity,
                                   std::int64_t from_us, std::int64_t to_us);

/// The mean of |quantity| over a window of each run, and the distribution of these means over the runs.
struct RunMeans {
  double mean = 0;
  double standard_deviation = 0;  ///< with divisor n - 1
  double largest = 0;
  std::size_t missing = 0;  ///< runs that ended early, were silent, or had a value that is not finite
};
RunMeans run_means(std::span<const RunSeries> runs, const Quantity& quantity, std::int64_t from_us,
                   std::int64_t to_us);

/// RMS and mean over all runs and over all samples within a window of the time to go [s]. Each sample of the
/// runs must cover an interval of the time to go (Layout::to_go_stretch_us > 0).
struct ToGoStatistics {
  double rms = 0, mean = 0;  ///< of the finite values [SI]
  std::size_t count = 0;     ///< number of finite values
  std::size_t missing = 0;   ///< runs that ended early or have too few finite values in the window
};
ToGoStatistics to_go_statistics(std::span<const RunSeries> runs, const Quantity& quantity, double least,
                                double most);

/// Compares runs in pairs with the same random numbers: the fraction of the pairs in which `a` is better.
struct PairedFraction {
  std::size_t better = 0;  ///< pairs in which `a` has the smaller |quantity|; a missing value is the worst
  std::size_t pairs = 0;
  double fraction = 0;
  double low = 0, high = 0;  ///< Clopper-Pearson interval of the probability
};
/// Compares the values at the last update at or before `t_us`. `a` and `b` must be ordered by run. A run
/// without a counterpart is ignored. `confidence` must be in (0, 1).
PairedFraction paired_fraction(std::span<const RunSeries> a, std::span<const RunSeries> b,
                               const Quantity& quantity, std::int64_t t_us, double confidence);

/// Tests whether the normalised squared errors in a window follow a chi-square distribution. Errors within
/// one run are correlated in time, so the bounds apply to the mean over runs at one update (Bar-Shalom, Li,
/// Kirubarajan (2001), section 5.4.2).
struct ConsistencyStatistics {
  double mean = 0;           ///< over all runs and updates
  double low = 0, high = 0;  ///< central interval of chi2(k n) / n, n: runs, k: degrees of freedom
  double inside = 0;         ///< fraction of the updates whose mean over runs lies in the interval
  std::size_t updates = 0;
  std::size_t missing = 0;
};
/// `quantity` must have degrees of freedom; `probability` must be in (0, 1).
ConsistencyStatistics consistency(std::span<const RunSeries> runs, const Quantity& quantity,
                                  std::int64_t from_us, std::int64_t to_us, double probability);

}  // namespace canhil::campaign
