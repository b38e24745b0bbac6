// Converts a log to another format.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/logs/log.hpp"

namespace canhil::recordings {

/// Writes the frames of the log `from` into a new log `to`, with its remote frames. Returns their number.
/// After an error (one line) there is no new file.
Result<std::uint64_t> convert(const std::string& from, const std::string& to, LogFormat format);

}  // namespace canhil::recordings
