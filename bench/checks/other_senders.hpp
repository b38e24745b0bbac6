// Whether bench and target were the only senders of their own messages.
#pragma once

#include <string>
#include <string_view>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// The implied check that fails when they were not.
inline constexpr std::string_view senders_kind = "senders";

/// Reports, in one line, other nodes that sent frames of the bench or repeated answers of the target; empty:
/// none. If there was one, the measurements may not be the target's.
std::string other_senders(const Observations& seen);

}  // namespace canhil::checks
