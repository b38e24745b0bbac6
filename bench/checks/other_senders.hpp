// Finds out whether bench and target were the only senders of their own messages.
#pragma once

#include <string>
#include <string_view>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// The implied check that is not measured if other nodes sent messages of the bench or of the target.
inline constexpr std::string_view senders_kind = "senders";

/// Reports, in one line, other nodes that sent frames of the bench or repeated answers of the target; empty:
/// none. With such a node, the measurements may not describe the target.
std::string other_senders(const Observations& seen);

}  // namespace canhil::checks
