// Update times and values of a variant's runs. A run has no value at a time at which its last update is
// stale. The estimator (bench/estimators) determines how old an update may be.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/campaign/series.hpp"

namespace canhil::campaign {

/// All update times [us] of any run, ascending, plus the times from which on all runs are stale.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, const Quantity& quantity);
/// The same within a window. Before the first update, the age of an update counts from the window's begin.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, std::int64_t from_us,
                                       std::int64_t to_us);

/// The quantity in a run's update at exactly that time; NaN: no update, or no finite value.
double value_at(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// Whether a missing value at that time is correct. There are two cases. The run has no update there, but its
/// last update (or the beginning of the window, `from_us`, if later) is not yet stale. Or the update lacks
/// the quantity, as an unused fix has no NIS.
bool may_be_missing(const RunSeries& run, const Quantity& quantity, std::int64_t t_us, std::int64_t from_us);
/// The quantity in a run's last update at or before a time. NaN: no update, stale, not finite, or the run had
/// ended.
double last_value(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// The magnitude of last_value().
double last_magnitude(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);

/// Whether a run is nowhere silent in a window for longer than the age limit of its updates.
bool answers_throughout(const RunSeries& run, std::int64_t from_us, std::int64_t to_us);
/// The expected number of samples between the times to go `most` and `least` [s], as far as the flight covers
/// this window; 0: unknown.
double samples_to_go(const quantities::Freshness& freshness, double least, double most);

}  // namespace canhil::campaign
