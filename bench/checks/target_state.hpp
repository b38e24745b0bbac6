// Judges what the target reported about its own state during the flight.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// The implied check (judge.hpp) that fails when the target reports a state that nothing explains.
inline constexpr std::string_view state_kind = "target_state";

/// Reports, in one line, what nothing explains: an estimator that does not run, an error bit, counts that
/// went down or an identity that changed. `events_us`: times of events outside the scenario that a check
/// judges. Empty: everything is explained. A fault of the scenario explains the errors after its onset; lost
/// input explains `input_lost` and `input_silent`. The state `fault` is not reported here, because it ends
/// the run.
std::string unexplained_state(const Observations& seen, std::span<const std::int64_t> events_us);

}  // namespace canhil::checks
