// A recorded log against a fresh device.
#pragma once

#include <cstdio>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::target {

/// Feeds every frame of a candump log to a fresh device and writes its answers in the same format, each with
/// the time of the frame that it answers. Error: the log cannot be read; one line with file, line and column.
Result<void> replay(const std::string& log_path, std::FILE* out);

}  // namespace canhil::target
