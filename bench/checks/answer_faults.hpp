// Structural faults in the target's answers, found before any value is judged.
#pragma once

#include <string>
#include <string_view>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// The implied check (judge.hpp) that fails when answers name causes that the bench did not send.
inline constexpr std::string_view causes_kind = "causes";
/// The implied check (judge.hpp) that fails when the messages of an answer group never form a whole group.
inline constexpr std::string_view groups_kind = "answer_groups";

/// Reports, in one line, the groups whose answers name a wrong cause. A cause is wrong if its time matches no
/// stimulus, or if its time and its counter belong to different stimuli. Empty: there is no such group.
std::string wrong_causes(const Observations& seen);

/// Reports, in one line, the groups whose messages arrived but never formed a whole group. For each of these
/// groups, names the messages that were missing or defective. Empty: there is no such group.
std::string broken_groups(const Observations& seen);

}  // namespace canhil::checks
