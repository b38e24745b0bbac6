#include "bench/checks/target_reports.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::checks {
namespace {

using namespace messages;

std::string at(std::int64_t t_us) { return fmt::format("{:g} s", static_cast<double>(t_us) * 1e-6); }

std::string name_or_number(std::string_view name, std::string_view what, int number) {
  return name.empty() ? fmt::format("{} {}", what, number) : std::string(name);
}

// One TargetCounters may be lost on the bus. If the one after it is missing too, the target has stopped
// sending it.
constexpr std::int64_t longest_age_us = 2 * std::int64_t{TargetCounters::info.cycle_time_us};

}  // namespace

void TargetReports::report(Report::Of of, std::int64_t now_us, Estimator estimator, std::string_view what) {
  const std::string by = name_or_number(name_of(estimator), "estimator", static_cast<int>(estimator));
  const bool known = std::ranges::any_of(
      reports_, [&](const Report& one) { return one.of == of && one.estimator == by && one.what == what; });
  constexpr std::size_t most = 64;  // more than there are states and error bits
  if (!known && reports_.size() < most)
    reports_.push_back({.of = of, .t_us = now_us, .estimator = by, .what = std::string(what)});
}

void TargetReports::hear(const TargetHeartbeat& beat, std::int64_t now_us) {
  ++heartbeats_;
  if (beat.state != TargetState::running)
    report(Report::Of::state, now_us, beat.estimator,
           name_or_number(name_of(beat.state), "state", static_cast<int>(beat.state)));
  TargetHeartbeat::visit(beat, [&](const SignalInfo& signal, const auto& value) {
    if (signal.name.starts_with(error_prefix) && static_cast<int>(value) != 0)
      report(Report::Of::error, now_us, beat.estimator, signal.name.substr(error_prefix.size()));
  });
  const auto [place, is_new] = first_.try_emplace(beat.estimator, beat);
  if (is_new) return;
  const TargetHeartbeat& first = place->second;
  const auto same = [&](std::string_view what, auto was, auto is) {
    if (was != is)
      report(Report::Of::identity, now_us, beat.estimator,
             fmt::format("{} {} -> {}", what, static_cast<int>(was), static_cast<int>(is)));
  };
  same("algorithm", first.algorithm, beat.algorithm);
  same("dbc_hash", first.dbc_hash, beat.dbc_hash);
  same("version_major", first.version_major, beat.version_major);
  same("version_minor", first.version_minor, beat.version_minor);
}

void TargetReports::hear(const TargetCounters& counters, std::int64_t now_us) {
  const auto went_down = [&](std::string_view what, auto was, auto is) {
    if (went_down_.empty() && is < was)
      went_down_ = fmt::format("{} {} -> {} at {}", what, was, is, at(now_us));
  };
  if (counters_) {
    went_down("frames lost", counters_->frames_lost, counters.frames_lost);
    went_down("bad CRC", counters_->bad_crc, counters.bad_crc);
    went_down("bad groups", counters_->bad_group, counters.bad_group);
    went_down("late", counters_->late, counters.late);
  }
  counters_ = counters;
  counters_us_ = now_us;
}

void TargetReports::restart() {
  first_.clear();
  counters_.reset();
}

std::optional<std::int64_t> TargetReports::counters_stopped_us() const {
  if (end_us_ - counters_us_ <= longest_age_us) return std::nullopt;
  return counters_us_;
}

std::string TargetReports::to_text() const {
  std::string text = fmt::format("{} heartbeats", heartbeats_);
  if (reports_.empty()) return text + ": running, no errors";
  std::string_view separator = ": ";
  for (const Report& one : reports_) {
    text += fmt::format("{}{} {} from {}", separator, one.estimator, one.what, at(one.t_us));
    separator = ", ";
  }
  return text;
}

}  // namespace canhil::checks
