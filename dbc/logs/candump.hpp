// The log format of can-utils (`candump -L`), so that candump, canplayer and log2asc can be used on our logs
// and ours on theirs: one line a frame,
//     (1436509052.249713) vcan0 044#2A366C2BBA R
// FD: ID##FDATA, F a hex digit of flags; extended and error frames have 8 digits of id. ` T` and ` R` at the
// end tell what the recorder sent and received; they may be missing (canplayer and log2asc take both). Times
// are written in microseconds, rounded down, as canplayer reads nine digits wrongly; nine digits are read
// (newer candump -N).
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
