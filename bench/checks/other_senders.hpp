// Finds out whether bench and target were the only senders of their own messages.
#pragma once

#include <string>
#include <string_view>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// The implied check (judge.hpp) whose outcome is 'not measured' if other nodes sent messages of the bench or
/// of the target.
inline constexpr std::string_view senders_kind = "senders";

/// Reports, in one line, two kinds of frames: frames that another node sent with ids of the bench, and
/// answers of the target that came more than once. Empty: there are no such frames. If there are such frames,
/// the measurements may not describe the target.
std::string other_senders(const Observations& seen);

}  // namespace canhil::checks
