// Judges the answers to the events of a scenario. They need no [[check]]: an event that expects an answer is
// judged.
#pragma once

#include <vector>

#include "bench/checks/evidence.hpp"
#include "bench/checks/verdict.hpp"
#include "bench/scenario/events.hpp"

namespace canhil::checks {

inline constexpr std::string_view event_kind = "event";

/// A result for each event that expects an answer, and for each other event that was not sent.
std::vector<CheckResult> judge_events(std::span<const scenario::Event> events, const Evidence& evidence);

}  // namespace canhil::checks
