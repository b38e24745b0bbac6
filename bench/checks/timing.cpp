#include "bench/checks/timing.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bench/checks/finding.hpp"

namespace canhil::checks {
namespace {

const MessageInfo* info_of(std::string_view message) {
  const auto found = std::ranges::find(messages::all_messages, message, &MessageInfo::name);
  return found == messages::all_messages.end() ? nullptr : &*found;
}

const std::vector<Arrival>& arrivals_of(const Observations& seen, const MessageInfo& info) {
  return seen.arrivals[static_cast<std::size_t>(&info - messages::all_messages.data())];
}

const std::vector<Stimulus>* stimuli_of(const Observations& seen, std::string_view group) {
  const auto found = seen.stimuli.find(group);
  return found == seen.stimuli.end() ? nullptr : &found->second;
}

// What a message answers in this run: the stimuli of each group that was sent.
std::vector<const std::vector<Stimulus>*> all_stimuli_of(const Observations& seen, const MessageInfo& info) {
  std::vector<const std::vector<Stimulus>*> all;
  for (const std::string_view group : info.answers) {
    const std::vector<Stimulus>* stimuli = stimuli_of(seen, group);
    if (stimuli != nullptr && !stimuli->empty()) all.push_back(stimuli);
  }
  return all;
}

}  // namespace

const Stimulus* find_stimulus(const Observations& seen, std::string_view group, std::int64_t valid_us) {
  const std::vector<Stimulus>* stimuli = stimuli_of(seen, group);
  if (stimuli == nullptr) return nullptr;
  const auto found = std::ranges::lower_bound(*stimuli, valid_us, {}, &Stimulus::valid_us);
  return found == stimuli->end() || found->valid_us != valid_us ? nullptr : &*found;
}

double quantile(std::vector<double> sample, double q) {
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(sample.size())));
  const auto nth = sample.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(sample.begin(), nth, sample.end());
  return *nth;
}

Distribution distribution(std::vector<double> sample) {
  if (sample.empty()) return {};
  std::ranges::sort(sample);
  const auto at = [&](double q) {
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(sample.size())));
    return sample[std::max<std::size_t>(rank, 1) - 1];
  };
  return {.count = sample.size(),
          .min = sample.front(),
          .p50 = at(0.5),
          .p90 = at(0.9),
          .p99 = at(0.99),
          .p999 = at(0.999),
          .max = sample.back()};
}

Distribution distribution_s(const Histogram& histogram) {
  const auto at = [&](double q) { return histogram.quantile_ns(q) * 1e-9; };
  return {.count = histogram.count(),
          .min = static_cast<double>(histogram.min_ns()) * 1e-9,
          .p50 = at(0.5),
          .p90 = at(0.9),
          .p99 = at(0.99),
          .p999 = at(0.999),
          .max = static_cast<double>(histogram.max_ns()) * 1e-9};
}

std::vector<double> latencies_s(const Observations& seen, std::string_view message,
                                const scenario::Window& window) {
  std::vector<double> sample;
  const MessageInfo* info = info_of(message);
  if (info == nullptr) return sample;
  for (const Arrival& arrival : arrivals_of(seen, *info)) {
    if (!within(window, arrival.cause_us)) continue;
    const Stimulus* cause = find_stimulus(seen, arrival.cause_group, arrival.cause_us);
    if (cause != nullptr) sample.push_back(elapsed_s(*cause, arrival));
  }
  return sample;
}

std::size_t unanswered(const Observations& seen, std::string_view message) {
  const MessageInfo* info = info_of(message);
  if (info == nullptr) return 0;
  const auto all = all_stimuli_of(seen, *info);
  std::size_t due = 0;
  for (const std::vector<Stimulus>* stimuli : all) due += stimuli->size();
  const double period_s = nominal_period_s(seen, message);
  if (all.size() == 1 && period_s > 0) {
    const double span_s = static_cast<double>(all[0]->back().valid_us - all[0]->front().valid_us) * 1e-6;
    due = std::min(due, static_cast<std::size_t>(std::lround(span_s / period_s)) + 1);
  }
  const auto came = static_cast<std::size_t>(
      std::ranges::count_if(arrivals_of(seen, *info), [](const Arrival& a) { return a.cause_us >= 0; }));
  return due - std::min(due, came);
}

std::vector<double> periods_s(const Observations& seen, std::string_view message,
                              const scenario::Window& window) {
  std::vector<double> sample;
  const MessageInfo* info = info_of(message);
  if (info == nullptr) return sample;
  const bool answers = !info->answers.empty();
  const Arrival* before = nullptr;
  for (const Arrival& arrival : arrivals_of(seen, *info)) {
    if (answers && !within(window, arrival.cause_us)) continue;
    if (before != nullptr) sample.push_back(elapsed_s(*before, arrival));
    before = &arrival;
  }
  return sample;
}

std::vector<double> stimulus_deviations_s(const Observations& seen, std::string_view message,
                                          const scenario::Window& window) {
  std::vector<double> sample;
  const MessageInfo* info = info_of(message);
  if (info == nullptr) return sample;
  for (const std::vector<Stimulus>* stimuli : all_stimuli_of(seen, *info)) {
    for (std::size_t i = 1; i < stimuli->size(); ++i) {
      const Stimulus &from = (*stimuli)[i - 1], &to = (*stimuli)[i];
      if (!within(window, to.valid_us)) continue;
      const double period_s = elapsed_s(from, to);
      const double due_s = static_cast<double>(to.due_ns - from.due_ns) * 1e-9;
      const double times = due_s > 0 ? std::max(1.0, std::round(period_s / due_s)) : 1.0;
      sample.insert(sample.end(), static_cast<std::size_t>(times), std::abs(period_s - due_s));
    }
  }
  return sample;
}

bool stamped_by_hardware(const Observations& seen) {
  const auto stamped = [](const auto& one) { return one.hardware_ns != 0; };
  bool any = false;
  for (const auto& [group, stimuli] : seen.stimuli) {
    any = any || !stimuli.empty();
    if (!std::ranges::all_of(stimuli, stamped)) return false;
  }
  return any && std::ranges::all_of(seen.arrivals, [&](const std::vector<Arrival>& arrivals) {
           return std::ranges::all_of(arrivals, stamped);
         });
}

double longest_silence_s(const Observations& seen, std::string_view message) {
  const MessageInfo* info = info_of(message);
  std::int64_t longest_ns = 0;
  std::int64_t before_ns = seen.first_ns;
  if (info != nullptr) {
    for (const Arrival& arrival : arrivals_of(seen, *info)) {
      longest_ns = std::max(longest_ns, arrival.t_ns - before_ns);
      before_ns = arrival.t_ns;
    }
  }
  return static_cast<double>(std::max(longest_ns, seen.last_ns - before_ns)) * 1e-9;
}

double ended_before_s(const Observations& seen, std::string_view message, const scenario::Window& window) {
  const MessageInfo* info = info_of(message);
  double ended_s = std::numeric_limits<double>::infinity();
  if (info == nullptr) return ended_s;
  const auto all = all_stimuli_of(seen, *info);
  std::int64_t end_ns = all.empty() ? seen.last_ns : 0;
  for (const std::vector<Stimulus>* stimuli : all) {
    const auto after = std::ranges::upper_bound(*stimuli, window.to_us, {}, &Stimulus::valid_us);
    end_ns = std::max(end_ns, after == stimuli->begin() ? seen.last_ns : std::prev(after)->t_ns);
  }
  for (const Arrival& arrival : arrivals_of(seen, *info)) {
    if (all.empty() || within(window, arrival.cause_us))
      ended_s = static_cast<double>(end_ns - arrival.t_ns) * 1e-9;
  }
  return ended_s;
}

double nominal_period_s(const Observations& seen, std::string_view message) {
  const MessageInfo* info = info_of(message);
  if (info == nullptr) return 0;
  const double cycle_s = static_cast<double>(info->cycle_time_us) * 1e-6;
  const auto all = all_stimuli_of(seen, *info);
  if (all.size() > 1) return 0;
  if (all.empty() || all[0]->size() < 2) return cycle_s;
  const std::vector<Stimulus>& stimuli = *all[0];
  const double span_us = static_cast<double>(stimuli.back().valid_us - stimuli.front().valid_us);
  const double stimulus_s = span_us / static_cast<double>(stimuli.size() - 1) * 1e-6;
  // Navigation answers keep an interval of their own where the IMU is faster.
  const bool navigation = info->sample_group == messages::AlignVelocityD::info.sample_group ||
                          info->sample_group == messages::FixVelocityD::info.sample_group;
  return navigation ? std::max(cycle_s, stimulus_s) : stimulus_s;
}

}  // namespace canhil::checks
