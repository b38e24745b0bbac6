// The timing of a run as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/drive/session.hpp"

namespace canhil::report {

using Json = nlohmann::ordered_json;

/// Adds latency, jitter and lateness of all observed messages; adds nothing in lockstep, where time is
/// virtual.
void add_timing(Json& page, const scenario::Scenario& scenario, const drive::Run& run);

/// The host's influence on the run and, if timing is not judged, the reason.
Json timing_judged(const drive::Run& run);

}  // namespace canhil::report
