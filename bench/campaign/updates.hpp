// Update times and values of a variant's runs. A run has no value at a time at which its last update is
// stale. The estimator (bench/estimators) determines how old an update may be.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/campaign/series.hpp"

namespace canhil::campaign {

/// The latest time [us] at which a run can contain an answer.
std::int64_t end_of(const RunSeries& run);
/// Whether a run's last update is stale at the end of the run, or there is none.
bool silent_at_end(const RunSeries& run);

/// The times [us] at which at least one run has an update, ascending. In a gap so long that the last updates
/// of all runs become stale, the result also contains the times at which this happens.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, const Quantity& quantity);
/// The times that update_times(runs, quantity) would return within a window. Before the first update in the
/// window, the age of an update is measured from the beginning of the window.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, std::int64_t from_us,
                                       std::int64_t to_us);

/// The value of the quantity in a run's update at exactly `t_us`. NaN: there is no update, or no finite
/// value.
double value_at(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// Whether the value at `t_us` may be missing. It may be missing in two cases. The first: the run has no
/// update at `t_us`, but its last update is not yet stale. (If that update came before the window, its age is
/// measured from `from_us`, the beginning of the window.) The second: the update does not contain the
/// quantity, for example the NIS of a fix that was not used.
bool may_be_missing(const RunSeries& run, const Quantity& quantity, std::int64_t t_us, std::int64_t from_us);
/// The value of the quantity in a run's last update at or before `t_us`. NaN: there is no update, the update
/// is stale or not finite, or the run had ended.
double last_value(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// The magnitude of last_value().
double last_magnitude(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);

/// Whether a run is, within a window, never silent for longer than the age limit of its updates.
bool answers_throughout(const RunSeries& run, std::int64_t from_us, std::int64_t to_us);
/// The expected number of samples whose time to go is between `least` and `most` [s]. If the flight covers
/// only a part of this window, the samples of this part are counted. 0: unknown.
double samples_to_go(const quantities::Freshness& freshness, double least, double most);

}  // namespace canhil::campaign
