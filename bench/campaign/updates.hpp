// When the runs of a variant were updated, and what they said of a time. An update that is stale by then, by
// the rule of its estimator (bench/estimators), says nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/campaign/series.hpp"

namespace canhil::campaign {

/// Update times [us] that any run has, ascending, and those at which all runs are stale: nobody has an update
/// there, so that whoever asks for its value finds it missing.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, const Quantity& quantity);
/// Those within a window; runs that have not begun are stale too.
std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, std::int64_t from_us,
                                       std::int64_t to_us);

/// The quantity of a run's update at exactly that time; NaN: it has none, or no finite value.
double value_at(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// Whether a run has an update at that time that was not asked for the quantity, as a fix that was not used
/// has no NIS: nothing is missing then.
bool is_untold(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);
/// |value| of a run at the last of these times (of its variant) at or before a time; infinite: none.
double magnitude_at(const RunSeries& run, const Quantity& quantity, std::span<const std::int64_t> times,
                    std::int64_t t_us);
/// |value| of a run at its own last update at or before a time; NaN: none, a stale one, or the run had ended.
double last_magnitude(const RunSeries& run, const Quantity& quantity, std::int64_t t_us);

/// Whether a run leaves no stretch of a window unanswered.
bool answers_throughout(const RunSeries& run, std::int64_t from_us, std::int64_t to_us);
/// How many samples a window of the time to go [s] should have, as far as it is flown; 0: not known.
double samples_to_go(const quantities::Freshness& freshness, double least, double most);

}  // namespace canhil::campaign
