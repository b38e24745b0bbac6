// The frames of a run around the worst value of each check, decoded.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bench/drive/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::report {

/// The key `frames` of a report: for each check whose worst value has a time, the frames before and after it
/// with their signals, as the DBCs of the scenario's bus describe them. `run.frames` must not be null.
nlohmann::ordered_json frames_around_worst(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
