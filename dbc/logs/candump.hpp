// The log format of can-utils (`candump -L`), compatible with candump, canplayer and log2asc. Each line has
// one frame, for example
//     (1436509052.249713) vcan0 044#2A366C2BBA R
// A CAN FD frame is ID##FDATA, where F is a hex digit with flags. A remote frame is ID#R, with the number of
// requested bytes after R. Extended frames and error frames have an id of 8 digits. After classic data of 8
// bytes, "_" and a hex digit may state a data length code above 8, which is ignored. An optional letter at
// the end of the line shows whether the recorder sent (` T`) or received (` R`) the frame; canplayer and
// log2asc accept lines with and without this letter. The writer rounds times down to microseconds and writes
// six digits after the point, because canplayer misreads nine digits. The reader also accepts times with nine
// digits, which newer versions of `candump -N` write.
//
// The format in which candump shows frames on the screen is read too (candump_screen.hpp).
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
