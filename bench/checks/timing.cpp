#include "bench/checks/timing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace canhil::checks {
namespace {

const MessageInfo* info_of(const Observations& seen, std::string_view message) {
  const auto found = std::ranges::find(seen.timing.messages, message, &MessageInfo::name);
  return found == seen.timing.messages.end() ? nullptr : &*found;
}

std::size_t place_of(const Observations& seen, const MessageInfo& info) {
  return static_cast<std::size_t>(&info - seen.timing.messages.data());
}

const AnswerTiming& timing_of(const Observations& seen, const MessageInfo& info) {
  return seen.timing.answers[place_of(seen, info)];
}

// The counts of the stimuli that a message answers: one entry for each sample group that was sent in this
// run.
std::vector<StimulusCount> all_stimuli_of(const Observations& seen, const MessageInfo& info) {
  std::vector<StimulusCount> all;
  for (const std::string_view group : info.answers) {
    const auto found = seen.stimuli.find(group);
    if (found != seen.stimuli.end() && found->second.count > 0) all.push_back(found->second);
  }
  return all;
}

// The number of answers that the target owed in a message.
std::uint64_t answers_due(const Observations& seen, const MessageInfo& info) {
  const auto all = all_stimuli_of(seen, info);
  std::uint64_t due = 0;
  for (const StimulusCount& stimuli : all) due += stimuli.count;
  const double period_s = nominal_period_s(seen, info.name);
  if (all.size() != 1 || period_s <= 0) return due;
  const double span_s = static_cast<double>(all[0].last_us - all[0].first_us) * 1e-6;
  return std::min(due, static_cast<std::uint64_t>(std::lround(span_s / period_s)) + 1);
}

bool same(const scenario::Window& a, const scenario::Window& b) {
  return a.from_us == b.from_us && a.to_us == b.to_us;
}

// The index of the quantile q in a sorted sample of `count` values, by the nearest-rank method.
std::size_t place_of(double q, std::size_t count) { return nearest_rank(q, count) - 1; }

template <class At>
Distribution distribution_of(std::size_t count, double min, double max, At at) {
  return {.count = count,
          .min = min,
          .p50 = at(0.5),
          .p90 = at(0.9),
          .p99 = at(0.99),
          .p999 = at(0.999),
          .max = max};
}

}  // namespace

double quantile(std::vector<double> sample, double q) {
  const auto nth = sample.begin() + static_cast<std::ptrdiff_t>(place_of(q, sample.size()));
  std::nth_element(sample.begin(), nth, sample.end());
  return *nth;
}

Distribution distribution(std::vector<double> sample) {
  if (sample.empty()) return {};
  std::ranges::sort(sample);
  return distribution_of(sample.size(), sample.front(), sample.back(),
                         [&](double q) { return sample[place_of(q, sample.size())]; });
}

Distribution distribution_s(const Histogram& histogram) {
  return distribution_of(histogram.count(), static_cast<double>(histogram.min_ns()) * 1e-9,
                         static_cast<double>(histogram.max_ns()) * 1e-9,
                         [&](double q) { return histogram.quantile_ns(q) * 1e-9; });
}

std::optional<double> quantile_s(const Histogram& recorded, double q, std::uint64_t missing) {
  const std::uint64_t came = recorded.count();
  if (missing == 0 && came > 0) return recorded.quantile_ns(q) * 1e-9;
  const std::size_t place = place_of(q, came + missing);
  if (place >= came) return std::nullopt;
  // The quantile of the recorded values that has this rank; half a rank less, so that rounding cannot add
  // one.
  return recorded.quantile_ns((static_cast<double>(place) + 0.5) / static_cast<double>(came)) * 1e-9;
}

const TimedWindow* find_window(const TimingRecord& timing, std::string_view message,
                               const scenario::Window& window) {
  const auto found = std::ranges::find_if(timing.windows, [&](const TimedWindow& timed) {
    return timing.messages[timed.message].name == message && same(timed.window, window);
  });
  return found == timing.windows.end() ? nullptr : &*found;
}

bool stamped_by_hardware(const TimingRecord& timing) {
  return timing.stimuli_with_hardware_stamp > 0 && timing.without_hardware_stamp == 0;
}

std::optional<std::uint64_t> due(const Observations& seen, std::string_view message, double duration_s,
                                 std::size_t estimators) {
  const MessageInfo* info = info_of(seen, message);
  if (info == nullptr) return std::nullopt;
  if (!info->answers.empty()) return answers_due(seen, *info);
  if (info->cycle_time_us == 0) return std::nullopt;
  const double cycles = duration_s / (1e-6 * static_cast<double>(info->cycle_time_us));
  return estimators * (static_cast<std::uint64_t>(cycles) + 1);
}

std::size_t unanswered(const Observations& seen, std::string_view message) {
  const MessageInfo* info = info_of(seen, message);
  if (info == nullptr) return 0;
  const std::uint64_t due = answers_due(seen, *info);
  return due - std::min(due, seen.answers[place_of(seen, *info)]);
}

PeriodDeviation period_deviation(const Histogram& periods, double nominal_s, double begin_s, double end_s,
                                 double quantile, double permitted_s) {
  std::vector<std::pair<double, std::uint64_t>> deviations;
  PeriodDeviation found;
  const auto add = [&](double period_s, std::uint64_t times) {
    times *= static_cast<std::uint64_t>(std::max(1.0, std::round(period_s / nominal_s)));
    deviations.emplace_back(std::abs(period_s - nominal_s), times);
    found.count += times;
    if (deviations.back().first > permitted_s) found.outside += times;
  };
  const auto least_s = static_cast<double>(periods.min_ns()) * 1e-9;
  const auto most_s = static_cast<double>(periods.max_ns()) * 1e-9;
  for (const Histogram::Bucket& bucket : periods.buckets()) {
    add(std::clamp(bucket_middle_us(bucket.from_us) * 1e-6, least_s, most_s), bucket.count);
  }
  for (const double silent_s : {begin_s, end_s}) {
    if (silent_s > nominal_s) add(silent_s, 1);
  }
  std::ranges::sort(deviations);
  const std::uint64_t rank = nearest_rank(quantile, found.count);
  std::uint64_t passed = 0;
  for (const auto& [off_s, times] : deviations) {
    passed += times;
    found.off_s = off_s;
    if (passed >= rank) break;
  }
  return found;
}

Silence longest_silence(const Observations& seen, std::string_view message) {
  const MessageInfo* info = info_of(seen, message);
  if (info == nullptr) return {.from_ns = seen.first_ns, .length_ns = seen.last_ns - seen.first_ns};
  const AnswerTiming& timing = timing_of(seen, *info);
  const std::int64_t last_ns = timing.last_ns.value_or(seen.first_ns);
  if (seen.last_ns - last_ns >= timing.longest_silence_ns)
    return {.from_ns = last_ns, .length_ns = seen.last_ns - last_ns};
  return {.from_ns = timing.silent_from_ns, .length_ns = timing.longest_silence_ns};
}

double ended_before_s(const Observations& seen, const TimedWindow& window) {
  const bool answers = !all_stimuli_of(seen, seen.timing.messages[window.message]).empty();
  const std::int64_t end_ns = answers ? window.last_stimulus_ns.value_or(seen.last_ns) : seen.last_ns;
  return static_cast<double>(end_ns - window.last_arrival.value_or(Arrival{}).t_ns) * 1e-9;
}

double began_after_s(const Observations& seen, const TimedWindow& window) {
  const bool answers = !all_stimuli_of(seen, seen.timing.messages[window.message]).empty();
  const std::int64_t begin_ns = answers ? window.first_stimulus_ns.value_or(seen.first_ns) : seen.first_ns;
  return static_cast<double>(window.first_arrival.value_or(Arrival{}).t_ns - begin_ns) * 1e-9;
}

double nominal_period_s(const Observations& seen, std::string_view message) {
  const MessageInfo* info = info_of(seen, message);
  if (info == nullptr) return 0;
  const double cycle_s = static_cast<double>(info->cycle_time_us) * 1e-6;
  const auto all = all_stimuli_of(seen, *info);
  if (all.size() > 1) return 0;
  if (all.empty() || all[0].count < 2) return cycle_s;
  const double span_us = static_cast<double>(all[0].last_us - all[0].first_us);
  const double stimulus_s = span_us / static_cast<double>(all[0].count - 1) * 1e-6;
  const auto own = seen.own_interval_s.find(info->sample_group);
  return own == seen.own_interval_s.end() ? stimulus_s : std::max(own->second, stimulus_s);
}

}  // namespace canhil::checks
