// Structural faults in the target's answers, found before any value is judged.
#pragma once

#include <string>
#include <string_view>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// The implied check that fails when answers name causes that the bench did not send.
inline constexpr std::string_view causes_kind = "causes";
/// The implied check that fails when the messages of an answer group never form a whole group.
inline constexpr std::string_view groups_kind = "answer_groups";

/// For each group: answers whose cause time matches no stimulus, and answers whose counter and cause time
/// belong to different stimuli. One line; empty: none.
std::string wrong_causes(const Observations& seen);

/// Groups whose messages arrived but never formed a whole group, and the message that prevented it. One line;
/// empty: none.
std::string broken_groups(const Observations& seen);

}  // namespace canhil::checks
