// When the runs of a variant were updated, and what they said of a time. An update that is stale by then, by
// the rule of its estimator (bench/estimators), says nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/campaign/series.hpp"

namespace canhil::campaign {

/// Update times [us] that any run has, ascending, and those from which on all runs are stale.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, const Quantity& quantity);
/// Those within a window; runs that have not begun are stale too.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, std::int64_t from_us,
                                       std::int64_t to_us);

/// The quantity of a run's update at exactly that time; NaN: it has none, or no finite value.
double value_at(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// Whether a run has no value of the quantity at that time and none was due: it has no update there, as one
/// that was lost, and its last one, or the beginning of the window if that is later, is not stale; or the
/// update was not asked for the quantity, as a fix that was not used has no NIS.
bool is_untold(const RunSeries& run, const Quantity& quantity, std::int64_t t_us, std::int64_t from_us);
/// The quantity of a run's own last update at or before a time; NaN: none, a stale one, no finite value, or
/// the run had ended.
double last_value(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// Its magnitude.
double last_magnitude(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);

/// Whether a run leaves no stretch of a window unanswered.
bool answers_throughout(const RunSeries& run, std::int64_t from_us, std::int64_t to_us);
/// How many samples a window of the time to go [s] should have, as far as it is flown; 0: not known.
double samples_to_go(const quantities::Freshness& freshness, double least, double most);

}  // namespace canhil::campaign
