#include "bench/checks/complaints.hpp"

#include <algorithm>

#include "bench/checks/silence.hpp"

namespace canhil::checks {
namespace {

constexpr std::string_view error = "error_", e2e = "e2e_";

// Returns the name of an error bit without the prefix "error_". Empty: the signal is not an error bit.
std::string_view error_in(const SignalInfo& signal) {
  return signal.name.starts_with(error) ? signal.name.substr(error.size()) : std::string_view();
}

// If the messages differ, visits every signal, with the values of the signal in `now` and in `before`.
template <class Message, class Visit>
void compare(const Message& now, const Message& before, Visit visit) {
  if (now == before) return;  // nearly always
  std::vector<double> then;
  Message::visit(before,
                 [&](const SignalInfo&, const auto& value) { then.push_back(static_cast<double>(value)); });
  auto place = then.begin();
  Message::visit(now, [&](const SignalInfo& signal, const auto& value) {
    visit(signal, static_cast<double>(value), *place++);
  });
}

}  // namespace

void Complaints::hear(const messages::TargetHeartbeat& beat, std::int64_t now_us) {
  end(now_us);
  last_beat_us_ = now_us;
  messages::TargetHeartbeat& last = beats_[beat.estimator];
  compare(beat, last, [&](const SignalInfo& signal, double value, double before) {
    if (const std::string_view what = error_in(signal); !what.empty() && value != 0 && before == 0)
      of_heartbeats_.push_back({now_us, what});
  });
  if (beat.degraded != 0) of_heartbeats_.push_back({now_us, "degraded"});
  last = beat;
}

void Complaints::hear(const messages::TargetCounters& counters, std::int64_t now_us) {
  compare(counters, counters_.value_or(messages::TargetCounters{}),
          [&](const SignalInfo& signal, double value, double before) {
            if (!signal.name.starts_with(e2e) && value > before)
              of_counters_.push_back({now_us, signal.name});
          });
  counters_ = counters;
}

void Complaints::end(std::int64_t now_us) {
  const double longest = longest_wait_us(static_cast<double>(messages::TargetHeartbeat::info.cycle_time_us));
  if (static_cast<double>(now_us - last_beat_us_) > longest)
    silences_.push_back({.from_us = last_beat_us_, .to_us = now_us});
}

std::vector<std::string_view> Complaints::names() {
  std::vector<std::string_view> words{"degraded"};
  for (const SignalInfo& signal : messages::TargetHeartbeat::signals()) {
    if (const std::string_view what = error_in(signal); !what.empty()) words.push_back(what);
  }
  for (const SignalInfo& signal : messages::TargetCounters::signals()) {
    if (!signal.name.starts_with(e2e)) words.push_back(signal.name);
  }
  return words;
}

}  // namespace canhil::checks
