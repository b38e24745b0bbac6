#include "bench/mapping/pairing.hpp"

#include <algorithm>
#include <limits>

namespace canhil::mapping {
namespace {

constexpr std::int64_t any_time = std::numeric_limits<std::int64_t>::max();

}  // namespace

void Pairing::sent(std::uint64_t echoed, std::int64_t valid_us, std::int64_t t_ns, const Give& give) {
  open_.push_back({.echoed = echoed, .valid_us = valid_us, .t_ns = t_ns});
  const std::uint64_t newest = first_ + open_.size() - 1;
  while (!waiting_.empty() && newest - waiting_.front().highest > patience) give_first(give);
  give_certain(give);
  forget();
}

void Pairing::answered(const Received& answer, std::uint64_t echoed, const Paired& otherwise,
                       const Give& give) {
  Waiting one{.paired = otherwise, .echoed = echoed};
  one.paired.answer = answer;
  const auto lowest = first_from(next_lowest_, echoed);
  const auto highest = last_before(first_ + open_.size(), echoed, answer.t_ns);
  one.open = lowest && highest && *lowest <= *highest;
  if (one.open) {
    one.lowest = *lowest;
    one.highest = *highest;
    next_lowest_ = one.lowest + 1;
    // The causes of the answers before are older.
    std::uint64_t below = one.highest;
    for (auto before = waiting_.rbegin(); before != waiting_.rend(); ++before) {
      if (!before->open) continue;
      if (before->highest < below) break;
      before->highest = last_before(below, before->echoed, any_time).value_or(before->lowest);
      below = before->highest;
    }
  } else if (!waiting_.empty()) {
    one.highest = waiting_.back().highest;  // waits no longer than the answer before
  }
  waiting_.push_back(one);
  give_certain(give);
  forget();
}

void Pairing::end(const Give& give) {
  while (!waiting_.empty()) give_first(give);
  first_ += open_.size();
  open_.clear();
  next_lowest_ = first_;
}

std::optional<std::uint64_t> Pairing::first_from(std::uint64_t number, std::uint64_t echoed) const {
  for (std::uint64_t one = std::max(number, first_); one < first_ + open_.size(); ++one) {
    if (stimulus(one).echoed == echoed) return one;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> Pairing::last_before(std::uint64_t number, std::uint64_t echoed,
                                                  std::int64_t t_ns) const {
  for (std::uint64_t one = number; one > first_; --one) {
    const Stimulus& before = stimulus(one - 1);
    if (before.echoed == echoed && before.t_ns <= t_ns) return one - 1;
  }
  return std::nullopt;
}

void Pairing::give_first(const Give& give) {
  const Waiting& one = waiting_.front();
  Paired paired = one.paired;
  if (one.open) {
    const Stimulus& latest = stimulus(one.highest);
    paired.cause_us = latest.valid_us;
    paired.certain = one.lowest == one.highest;
    paired.owed = true;
    if (const auto before = last_before(one.highest, one.echoed, any_time); before && !paired.certain)
      paired.apart_us = latest.valid_us - stimulus(*before).valid_us;
  }
  give(paired);
  waiting_.pop_front();
}

void Pairing::give_certain(const Give& give) {
  while (!waiting_.empty() && (!waiting_.front().open || waiting_.front().lowest == waiting_.front().highest))
    give_first(give);
}

// A stimulus is needed while it can be the cause of an answer that waits or of the next answer.
void Pairing::forget() {
  std::uint64_t needed = next_lowest_;
  for (const Waiting& one : waiting_) {
    if (!one.open) continue;
    needed = one.lowest;
    break;
  }
  while (!open_.empty() && (first_ < needed || open_.size() > most_open)) {
    open_.pop_front();
    ++first_;
  }
}

}  // namespace canhil::mapping
