// The timing of a run as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/drive/session.hpp"

namespace canhil::report {

using Json = nlohmann::ordered_json;

/// Adds latency, jitter and lateness of all messages that were seen. Not in lockstep: its time has no
/// meaning.
void add_timing(Json& page, const scenario::Scenario& scenario, const drive::Run& run);

/// What the host did, and why timing is not judged, if it is not.
Json timing_judged(const drive::Run& run);

}  // namespace canhil::report
