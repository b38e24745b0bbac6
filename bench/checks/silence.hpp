// The longest permitted wait for an answer. A longer wait is silence, and no check passes if there was
// silence. The checks of a run and the metrics of a campaign share this rule.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "bench/scenario/checks.hpp"

namespace canhil::checks {

/// This many consecutive fixes may remain unanswered.
inline constexpr int tolerated_fixes = 2;
/// A run may lose seeker samples on purpose, but the target must answer at least this fraction of all
/// samples.
inline constexpr double least_answered = 0.5;

/// A gap between answers that is longer than this time [us] counts as silence. The time is `periods` periods
/// of the answers, but at least one period plus one second.
constexpr double longest_wait_us(double period_us, double periods = 2) {
  constexpr double second_us = 1e6;
  return std::max(second_us + period_us, periods * period_us);
}

/// Finds the first part of a window in which no answer came for longer than `longest_us`. None: there is no
/// such part. `times`: the times [us] of the answers in the window, ascending. `end_us`: after this time of
/// the run no answers are expected.
template <class Times>
std::optional<scenario::Window> silent_stretch(const Times& times, const scenario::Window& window,
                                               std::int64_t end_us, double longest_us) {
  std::int64_t from_us = window.from_us;
  const auto silent_until = [&](std::int64_t t_us) {
    return t_us > from_us && static_cast<double>(t_us - from_us) > longest_us;
  };
  for (const std::int64_t t_us : times) {
    if (silent_until(t_us)) return scenario::Window{.from_us = from_us, .to_us = t_us};
    from_us = t_us;
  }
  const std::int64_t to_us = std::min(window.to_us, end_us);
  if (silent_until(to_us)) return scenario::Window{.from_us = from_us, .to_us = to_us};
  return std::nullopt;
}

}  // namespace canhil::checks
