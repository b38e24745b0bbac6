#include "bench/campaign/updates.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bench/campaign/seconds.hpp"
#include "bench/checks/silence.hpp"

namespace canhil::campaign {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool had_ended(const RunSeries& run, std::int64_t t_us) {
  return run.ending.kind != drive::Ending::Kind::completed && run.ending.t_us < t_us;
}

// Adds, up to `end_us`, the times at which an update becomes stale because no other update follows soon
// enough.
std::vector<std::int64_t> with_stale(const std::vector<std::int64_t>& times, std::int64_t end_us,
                                     std::int64_t age_limit_us) {
  std::vector<std::int64_t> all;
  const auto add_stale = [&](std::int64_t until_us) {
    if (all.empty()) return;
    while (until_us > all.back() && until_us - all.back() > age_limit_us)
      all.push_back(all.back() + age_limit_us + 1);
  };
  for (const std::int64_t t_us : times) {
    add_stale(t_us);
    all.push_back(t_us);
  }
  add_stale(end_us);
  return all;
}

std::int64_t end_of_all(std::span<const RunSeries> runs) {
  std::int64_t end_us = std::numeric_limits<std::int64_t>::min();
  for (const RunSeries& run : runs) end_us = std::max(end_us, end_of(run));
  return end_us;
}

// The update times of all runs, ascending.
std::vector<std::int64_t> all_times(std::span<const RunSeries> runs) {
  std::vector<std::int64_t> times;
  for (const RunSeries& run : runs) {
    std::vector<std::int64_t> both;
    std::ranges::set_union(times, run.samples.times(), std::back_inserter(both));
    times = std::move(both);
  }
  return times;
}

// Whether an update that a run contains at `updated_us` is stale at `t_us`. If the run ended before `t_us`,
// returns whether the update was stale at the end of the run.
bool stale(const RunSeries& run, const Quantity& quantity, std::int64_t updated_us, std::int64_t t_us) {
  if (quantity.of_whole_run) return false;
  const std::int64_t until_us = std::min(t_us, end_of(run));
  return until_us > updated_us && until_us - updated_us > run.freshness.age_limit_us;
}

}  // namespace

std::int64_t end_of(const RunSeries& run) {
  if (run.samples.empty()) return run.freshness.end_us;
  const std::size_t last = run.samples.size() - 1;
  // If the final event (such as the passage) is missing, the end is unknown, and the time of the last sample
  // is used in its place.
  const Quantity* known_by = run.samples.layout().end_known_by;
  const bool open = known_by != nullptr && std::isnan(run.samples.value(last, *known_by));
  return open ? run.samples.times()[last] : run.freshness.end_us;
}

bool silent_at_end(const RunSeries& run) {
  const std::int64_t end_us = end_of(run);
  if (run.samples.empty()) return true;
  const std::int64_t last_us = run.samples.times().back();
  return end_us > last_us && end_us - last_us > run.freshness.age_limit_us;
}

std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, const Quantity& quantity) {
  std::vector<std::int64_t> times = all_times(runs);
  if (runs.empty() || quantity.of_whole_run) return times;
  return with_stale(times, end_of_all(runs), runs.front().freshness.age_limit_us);
}

std::vector<std::int64_t> update_times(std::span<const RunSeries> runs, std::int64_t from_us,
                                       std::int64_t to_us) {
  std::vector<std::int64_t> times = all_times(runs);
  std::erase_if(times, [&](std::int64_t t_us) { return t_us < from_us || t_us > to_us; });
  if (runs.empty()) return times;
  const bool begins_there = !times.empty() && times.front() == from_us;
  if (!begins_there) times.insert(times.begin(), from_us);
  times = with_stale(times, std::min(to_us, end_of_all(runs)), runs.front().freshness.age_limit_us);
  if (!begins_there) times.erase(times.begin());
  return times;
}

double value_at(const RunSeries& run, const Quantity& quantity, std::int64_t t_us) {
  const auto times = run.samples.times();
  const auto at = std::ranges::lower_bound(times, t_us);
  if (at == times.end() || *at != t_us) return nan;
  const double value = run.samples.value(static_cast<std::size_t>(at - times.begin()), quantity);
  return std::isfinite(value) ? value : nan;
}

bool may_be_missing(const RunSeries& run, const Quantity& quantity, std::int64_t t_us, std::int64_t from_us) {
  const auto times = run.samples.times();
  auto index = static_cast<std::size_t>(std::ranges::lower_bound(times, t_us) - times.begin());
  if (index == times.size() || times[index] != t_us) {
    const std::int64_t heard_us = index == 0 ? from_us : std::max(from_us, times[index - 1]);
    return !had_ended(run, t_us) && !stale(run, quantity, heard_us, t_us);
  }
  const auto not_asked = [&] { return std::isnan(run.samples.value(index, quantity)); };
  if (!quantity.nan_allowed || !not_asked()) return false;
  // With answers_may_omit, an answer without an update (for example while coasting) omits the quantity.
  if (run.samples.layout().answers_may_omit) return true;
  while (index > 0 && t_us - times[--index] <= run.freshness.age_limit_us) {
    if (!not_asked()) return true;
  }
  return false;
}

double last_value(const RunSeries& run, const Quantity& quantity, std::int64_t t_us) {
  const auto times = run.samples.times();
  const auto after = std::ranges::upper_bound(times, t_us) - times.begin();
  if (had_ended(run, t_us) || after == 0) return nan;
  if (stale(run, quantity, times[static_cast<std::size_t>(after - 1)], t_us)) return nan;
  const double value = run.samples.value(static_cast<std::size_t>(after - 1), quantity);
  return std::isfinite(value) ? value : nan;
}

double last_magnitude(const RunSeries& run, const Quantity& quantity, std::int64_t t_us) {
  return std::abs(last_value(run, quantity, t_us));
}

bool answers_throughout(const RunSeries& run, std::int64_t from_us, std::int64_t to_us) {
  const auto times = run.samples.times();
  const auto from = std::ranges::lower_bound(times, from_us), to = std::ranges::upper_bound(times, to_us);
  return !checks::silent_stretch(std::span(from, to), {.from_us = from_us, .to_us = to_us}, end_of(run),
                                 static_cast<double>(run.freshness.age_limit_us));
}

double samples_to_go(const quantities::Freshness& freshness, double least, double most) {
  if (freshness.sample_us == 0) return 0;
  const double flown = std::min(most, -seconds(freshness.begin_us)) - least;
  return std::max(0.0, flown / seconds(freshness.sample_us));
}

}  // namespace canhil::campaign
