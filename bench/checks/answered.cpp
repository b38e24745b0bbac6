#include "bench/checks/answered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/checks/silence.hpp"
#include "bench/checks/timing.hpp"

namespace canhil::checks {
namespace {

// A sample that was sent just before the target's process is stopped or killed, or before the target gives
// up, may remain unanswered.
constexpr std::int64_t on_the_way_us = messages::TargetHeartbeat::info.cycle_time_us;
// A fault may move the times of validity beyond its end, and the first samples after it may then seem old.
constexpr std::int64_t settling_us = 100'000;

// The time from which no answers are due, because an estimator reported the state `fault`, which ends the
// run.
std::int64_t given_up_us(const Observations& seen) {
  const std::vector<Report>& reports = seen.reports.reports();
  const auto fault = std::ranges::find_if(reports, [](const Report& one) {
    return one.of == Report::Of::state && one.what == name_of(messages::TargetState::fault);
  });
  return fault == reports.end() ? std::numeric_limits<std::int64_t>::max() : fault->t_us - on_the_way_us;
}

bool is_excused(const Observations& seen, std::int64_t valid_us) {
  return std::ranges::any_of(seen.faults, [&](const FaultRecord& fault) {
    const std::int64_t from_us = fault.valid_from_us - (fault.of_target ? on_the_way_us : 0);
    return fault.count > 0 && valid_us >= from_us && valid_us <= fault.window.to_us + settling_us;
  });
}

// The records of the group's last message; null: there are none.
const Spool<OwedAnswer>* owed_by(const Observations& seen, const MessageInfo& info) {
  for (const auto& [index, owed] : seen.timing.owed) {
    if (is_in_group_of(info, seen.timing.messages[index])) return &owed;
  }
  return nullptr;
}

// The frames that the target counts beyond those that the bench withheld or damaged.
std::uint64_t lost_to_the_target(const Observations& seen) {
  if (!seen.counters) return 0;
  const LossCounts& most = seen.expected_counts.most;
  const auto beyond = [](std::uint64_t count, std::uint64_t expected) {
    return count - std::min(count, expected);
  };
  return beyond(seen.counters->frames_lost, most.frames_lost) + beyond(seen.counters->bad_crc, most.bad_crc) +
         beyond(seen.counters->bad_group, most.bad_group);
}

}  // namespace

bool closes_answer(std::span<const MessageInfo> messages, std::size_t index) {
  const MessageInfo& info = messages[index];
  return !info.answers.empty() &&
         (info.sample_group.empty() || std::ranges::none_of(messages, [&](const MessageInfo& other) {
            return other.sample_group == info.sample_group && other.id > info.id;
          }));
}

Answered answered(const Observations& seen, std::string_view message, const scenario::Window& window) {
  Answered found;
  const auto info = std::ranges::find(seen.timing.messages, message, &MessageInfo::name);
  if (info == seen.timing.messages.end()) return found;
  const Spool<OwedAnswer>* owed = owed_by(seen, *info);
  if (owed == nullptr) return found;
  if (!seen.answers_each_sample && info->cycle_time_us == 0) return found;
  const auto own = seen.own_interval_s.find(info->sample_group);
  const std::int64_t interval_us = own != seen.own_interval_s.end() ? std::llround(own->second * 1e6)
                                   : seen.answers_each_sample       ? 0
                                                                    : std::int64_t{info->cycle_time_us};
  const std::int64_t end_us = given_up_us(seen);
  std::optional<std::int64_t> counted_us, before_us;
  bool thinned = false;
  std::uint64_t stretches = 1;  // without a gap in the samples
  for (const OwedAnswer& one : *owed) {
    if (!within(window, one.valid_us) || one.valid_us >= end_us || is_excused(seen, one.valid_us)) continue;
    found.came += one.came ? 1 : 0;
    if (before_us && one.valid_us - *before_us > interval_us) ++stretches;
    before_us = one.valid_us;
    if (interval_us > 0 && counted_us && one.valid_us - *counted_us < interval_us) {
      thinned = true;
      continue;
    }
    counted_us = one.valid_us;
    ++found.due;
  }
  // The intervals of the target need not begin with the window, nor anew after a gap.
  if (thinned) found.due -= std::min(found.due, stretches);
  found.came = std::min(found.came, found.due);
  return found;
}

bool Answered::half() const { return static_cast<double>(came) >= least_answered * static_cast<double>(due); }

Finding too_few(const Observations& seen, std::string_view message, const Answered& found,
                Expected expected) {
  Finding why{.outcome = Outcome::fail,
              .measured = fmt::format("{}: answers to {} of {} samples", message, found.came, found.due),
              .expected = std::move(expected)};
  const std::uint64_t lost = lost_to_the_target(seen);
  std::string elsewhere = seen.bus.outages();
  if (found.came > 0 && lost > 0 && found.missing() <= seen.lost_from_target() + lost)
    elsewhere = fmt::format("{} frames were lost on the way to the target", lost);
  if (elsewhere.empty()) return why;
  why.outcome = Outcome::not_measured;
  why.measured += "; " + elsewhere;
  return why;
}

std::optional<Finding> missing_answers(const Observations& seen, std::string_view message,
                                       const scenario::Window& window) {
  const Answered found = answered(seen, message, window);
  const std::uint64_t missing = found.missing();
  if (found.half() && (!seen.answers_each_sample || missing <= seen.lost_from_target())) return std::nullopt;
  return too_few(seen, message, found);
}

}  // namespace canhil::checks
