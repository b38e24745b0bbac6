// Whether bench and target were the only ones to speak in their own names.
#pragma once

#include <string>
#include <string_view>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// Of the check that is there when somebody did.
inline constexpr std::string_view senders_kind = "senders";

/// Who else sent what only the bench sends, or answered what had been answered: one line; empty: nobody.
/// What was measured then need not be what was meant.
std::string other_senders(const Observations& seen);

}  // namespace canhil::checks
