// Converts a log to another format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dbc/logs/log.hpp"

namespace canhil::recordings {

struct Converted {
  std::uint64_t frames = 0;
  std::vector<std::string> remarks;  ///< see LogReader::remarks()
};

/// Writes the frames of the log `from` into a new log `to`, with its remote frames. After an error (one line)
/// there is no new file.
Result<Converted> convert(const std::string& from, const std::string& to, LogFormat format);

}  // namespace canhil::recordings
