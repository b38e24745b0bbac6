// Update times and values of a variant's runs. An update that is stale at a time, by the rule of its
// estimator (bench/estimators), has no value there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/campaign/series.hpp"

namespace canhil::campaign {

/// All update times [us] of any run, ascending, plus the times from which on all runs are stale.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, const Quantity& quantity);
/// The same within a window; runs that have not begun are stale too.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, std::int64_t from_us,
                                       std::int64_t to_us);

/// The quantity in a run's update at exactly that time; NaN: no update, or no finite value.
double value_at(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// Whether a run correctly has no value of the quantity at that time. Either it has no update there (it was
/// lost), and its last update or, if later, the beginning of the window is not yet stale; or the update does
/// not need the quantity: an unused fix has no NIS.
bool is_untold(const RunSeries& run, const Quantity& quantity, std::int64_t t_us, std::int64_t from_us);
/// The quantity in a run's last update at or before a time. NaN: no update, stale, not finite, or the run had
/// ended.
double last_value(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// The magnitude of last_value().
double last_magnitude(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);

/// Whether a run has answers in every stretch of a window.
bool answers_throughout(const RunSeries& run, std::int64_t from_us, std::int64_t to_us);
/// The expected number of samples in a window of the time to go [s], as far as it is flown; 0: unknown.
double samples_to_go(const quantities::Freshness& freshness, double least, double most);

}  // namespace canhil::campaign
