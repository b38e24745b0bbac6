// Converts a log to another format.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::recordings {

/// Writes the frames of one log into a new log, whose file name determines the format (dbc/logs/log.hpp).
/// Returns the number of frames. Error: one line; the new file is removed.
Result<std::uint64_t> convert(const std::string& from, const std::string& to);

}  // namespace canhil::recordings
