// What is wrong with the target's answers before anybody looks at their values.
#pragma once

#include <string>
#include <string_view>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// Of the check that is there when answers name causes that the bench did not send.
inline constexpr std::string_view causes_kind = "causes";
/// Of the check that is there when the messages of a group of answers never make a whole group.
inline constexpr std::string_view groups_kind = "answer_groups";

/// Answers whose time is that of no stimulus, and answers with the counter of another stimulus than that of
/// their time, by group: one line; empty: none.
std::string wrong_causes(const Observations& seen);

/// Groups of answers of which messages came and not one group was whole, and which message is to blame: one
/// line; empty: none.
std::string broken_groups(const Observations& seen);

}  // namespace canhil::checks
