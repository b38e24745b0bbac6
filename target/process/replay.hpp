// A recorded log against a fresh device.
#pragma once

#include <cstdio>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::target {

/// Feeds the bench's frames of a candump log to a fresh device and writes them with the device's answers, as
/// a log of its own: `hil-bench diverge` compares the two. Answers carry the time of the frame that they
/// answer. Error: the log cannot be read; one line with file, line and column.
Result<void> replay(const std::string& log_path, std::FILE* out);

}  // namespace canhil::target
