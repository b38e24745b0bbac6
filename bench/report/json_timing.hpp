// The timing of a run as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/checks/histogram.hpp"
#include "bench/drive/session.hpp"

namespace canhil::report {

using Json = nlohmann::ordered_json;

/// count, min, p50, p90, p99, p999, max [s], and buckets_us: [from, count] of those that are not empty.
Json object(const checks::Histogram& histogram);
/// stretch_s, and largest_s of each stretch from time 0 on; null where there was no value.
Json object(const checks::TimeLine& line);

/// Adds latency, jitter and lateness of all messages that were seen. Not in lockstep: its time has no
/// meaning.
void add_timing(Json& page, const scenario::Scenario& scenario, const drive::Run& run);

/// What the host did, and why timing is not judged, if it is not.
Json timing_judged(const drive::Run& run);

}  // namespace canhil::report
