// Judges a recorded run again.
#pragma once

#include "bench/drive/session.hpp"

namespace canhil::drive {

/// Flies a scenario against the frames of a log instead of a bus. The bench's frames must equal the
/// scenario's frames bit for bit; the target's frames are judged as in the run. Times come from the log.
/// Timing is not judged, because the log does not contain the bench's lateness. Error, one line: the log
/// belongs to another scenario, seed or DBC, or cannot be read. `also`: receives every frame of the flight;
/// null: nobody does.
Result<Run> judge_recording(const scenario::Scenario& scenario, const std::string& log,
                            observe::Observer* also = nullptr);

}  // namespace canhil::drive
