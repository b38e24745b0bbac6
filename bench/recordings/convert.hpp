// A log in another format.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/wire/result.hpp"

namespace canhil::recordings {

/// Writes the frames of one log into another, whose name says the format (dbc/logs/log.hpp). Gives how many.
/// Error: one line; then there is no new file.
Result<std::uint64_t> convert(const std::string& from, const std::string& to);

}  // namespace canhil::recordings
