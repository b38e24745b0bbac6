// The log format of can-utils (`candump -L`), compatible with candump, canplayer and log2asc: one frame per
// line,
//     (1436509052.249713) vcan0 044#2A366C2BBA R
// A CAN FD frame is ID##FDATA, where F is a hex digit with flags. Extended frames and error frames have an id
// of 8 digits. An optional ` T` at the end marks a frame that the recorder sent, ` R` one that it received;
// canplayer and log2asc accept lines with and without these letters. Times are written in microseconds,
// rounded down, because canplayer misreads nine digits. The reader also accepts times with nine digits (newer
// candump -N).
#pragma once

#include <string>
#include <string_view>

#include "dbc/logs/log.hpp"

namespace canhil {

/// The line of the log for an entry, without a line end.
std::string format_log_line(const LogEntry& entry);

/// Parses a line without a line end. The error is "WHERE:COLUMN: what was expected"; columns count from 1.
Result<LogEntry> parse_log_line(std::string_view line, std::string_view where);

}  // namespace canhil
