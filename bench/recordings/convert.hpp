// Converts a log to another format.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::recordings {

/// Writes the frames of the log `from` into a new log `to`. The file name of `to` determines the format
/// (dbc/logs/log.hpp). Returns the number of frames. After an error (one line) there is no new file.
Result<std::uint64_t> convert(const std::string& from, const std::string& to);

}  // namespace canhil::recordings
