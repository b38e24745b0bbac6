// A run that was recorded, judged again.
#pragma once

#include "bench/drive/session.hpp"

namespace canhil::drive {

/// Flies a scenario against the frames of a log in place of a bus. The bench's frames must be those that the
/// scenario sends, bit for bit; the target's are judged as in the run. Times are those of the log, and no
/// timing is judged, as the log does not say how late the bench was. Error: one line; the log is of another
/// scenario, seed or contract, or cannot be read.
Result<Run> judge_recording(const scenario::Scenario& scenario, const std::string& log);

}  // namespace canhil::drive
