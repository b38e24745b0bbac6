// Converts a log to another format.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::recordings {

/// Writes the frames of one log into another, whose name determines the format (dbc/logs/log.hpp). Returns
/// their number. Error: one line; then no new file remains.
Result<std::uint64_t> convert(const std::string& from, const std::string& to);

}  // namespace canhil::recordings
