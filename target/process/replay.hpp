// Replays a recorded log to a fresh device.
#pragma once

#include <cstdio>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::target {

/// Passes the bench's frames of a log to a fresh device. Writes these frames and the device's answers as a
/// new log; `hil-bench diverge` can compare the two logs. In the new log, each answer has the time stamp of
/// the frame that caused the answer. Error: the log cannot be read, or it is not the recording of a run. The
/// error message is one line with the file and, for a malformed entry, its line and column.
Result<void> replay(const std::string& log_path, std::FILE* out);

}  // namespace canhil::target
