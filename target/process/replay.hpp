// Replays a recorded log to a fresh device.
#pragma once

#include <cstdio>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::target {

/// Feeds the bench's frames of a log to a fresh device and writes them and the device's answers as a new log;
/// `hil-bench diverge` compares both logs. Answers have the time of the frame that they answer. Error: one
/// line with file, line and column; the log cannot be read.
Result<void> replay(const std::string& log_path, std::FILE* out);

}  // namespace canhil::target
