// The log format of can-utils (`candump -L`), compatible with candump, canplayer and log2asc: one frame per
// line,
//     (1436509052.249713) vcan0 044#2A366C2BBA R
// CAN FD: ID##FDATA, where F is a hex digit of flags. Extended and error frames have an id of 8 digits. An
// optional ` T` or ` R` at the end marks a frame that the recorder sent or received; canplayer and log2asc
// accept lines with and without it. Times are written in microseconds, rounded down, as canplayer misreads
// nine digits; times with nine digits (newer candump -N) are accepted.
#pragma once

#include <string>
#include <string_view>

#include "dbc/logs/log.hpp"

namespace canhil {

/// The line of an entry, without line end.
std::string format_log_line(const LogEntry& entry);

/// The entry of a line without its line end. Error: "WHERE:COLUMN: what was expected", columns from 1.
Result<LogEntry> parse_log_line(std::string_view line, std::string_view where);

}  // namespace canhil
