// Reads logs that are texts of a test.
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <vector>

#include "dbc/logs/candump.hpp"
#include "dbc/logs/log.hpp"

namespace canhil::test {

struct ReadLog {
  std::vector<std::string> lines;  ///< the entries as lines of candump
  std::vector<LogEntry> entries;
  std::vector<std::string> remarks;
  std::string error;  ///< empty: none
};

/// Reads a log in memory, whose name is "log".
inline ReadLog read_log(std::string_view content, RemoteFrames remote = RemoteFrames::kept) {
  ReadLog read;
  auto reader = LogReader::of_memory(content, "log", remote);
  if (!reader) {
    read.error = reader.error().message;
    return read;
  }
  for (;;) {
    auto entry = reader->next();
    if (!entry) read.error = entry.error().message;
    if (!entry || !*entry) break;
    read.lines.push_back(format_log_line(**entry));
    read.entries.push_back(std::move(**entry));
  }
  read.remarks = reader->remarks();
  return read;
}

}  // namespace canhil::test
