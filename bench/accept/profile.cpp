#include "bench/accept/profile.hpp"

#include <algorithm>
#include <cmath>

#include "bench/observe/values.hpp"
#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"

namespace canhil::accept {
namespace {

constexpr double full_turn_deg = 360;

/// True for signals that identify the program, such as its version. Such signals may differ between two
/// correct targets.
bool of_the_program(const SignalInfo& signal) {
  return signal.name.starts_with("version_") || signal.name == "dbc_hash";
}

// A direction: from -180 to 180 deg, or from 0 to 360 deg.
bool comes_round(const SignalInfo& signal) {
  return signal.unit == "deg" && signal.maximum - signal.minimum == full_turn_deg;
}

}  // namespace

double difference(const SignalInfo& signal, double a, double b) {
  return comes_round(signal) ? std::remainder(a - b, full_turn_deg) : a - b;
}

double distance(const SignalInfo& signal, double a, double b) { return std::abs(difference(signal, a, b)); }

std::optional<double> mean_difference(const Series& here, const Series& there, std::string_view signal) {
  const auto place = here.index_of(signal);
  if (!place || there.index_of(signal) != place) return std::nullopt;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0, j = 0; i < here.size() && j < there.size();) {
    if (here.t_s[i] != there.t_s[j]) {
      ++(here.t_s[i] < there.t_s[j] ? i : j);
      continue;
    }
    sum += difference(*here.signals[*place], here.value(i++, *place), there.value(j++, *place));
    ++count;
  }
  return count == 0 ? std::nullopt : std::optional(sum / static_cast<double>(count));
}

std::optional<double> first_difference(const Series& here, const Series& there, std::string_view signal) {
  const auto place = here.index_of(signal);
  if (!place || there.index_of(signal) != place) return std::nullopt;
  const std::size_t both = std::min(here.size(), there.size());
  for (std::size_t i = 0; i < both; ++i) {
    if (here.t_s[i] != there.t_s[i] || here.value(i, *place) != there.value(i, *place))
      return std::min(here.t_s[i], there.t_s[i]);
  }
  if (here.size() == there.size()) return std::nullopt;
  return (here.size() > both ? here : there).t_s[both];
}

std::optional<std::size_t> Series::index_of(std::string_view signal) const {
  const auto found = std::ranges::find(signals, signal, &SignalInfo::name);
  return found == signals.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - signals.begin()));
}

double Series::mean(std::size_t signal) const {
  double sum = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    // Angles are unwrapped relative to the first angle, because headings near south jump between +-180 deg.
    const double first = value(0, signal), now = value(i, signal);
    sum += comes_round(*signals[signal]) ? first + std::remainder(now - first, full_turn_deg) : now;
  }
  return size() == 0 ? 0 : sum / static_cast<double>(size());
}

void Answers::transmitted(const Frame& frame, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) {
  if (frame.id == messages::Sync::info.id && !frame.extended)
    t_s_ = 1e-6 * static_cast<double>(from_frame<messages::Sync>(frame).time_us);
}

void Answers::received(const Received& received) {
  if (received.own || !observe::is_answer(received.frame)) return;
  const auto values = observe::values_of(received.frame);
  if (values.empty()) return;
  auto& series = messages_[std::string(observe::message_of(received.frame))];
  const bool first = series.size() == 0;
  for (const observe::Value& value : values) {
    if (of_the_program(*value.signal)) continue;
    if (first) series.signals.push_back(value.signal);
    series.values.push_back(value.value);
  }
  series.t_s.push_back(t_s_);
}

const Series* Answers::find(std::string_view message) const {
  const auto found = messages_.find(message);
  return found == messages_.end() ? nullptr : &found->second;
}

}  // namespace canhil::accept
