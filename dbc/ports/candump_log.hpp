// The log format of can-utils (`candump -L`), so that candump, canplayer and log2asc can be used on our logs
// and ours on theirs: one line a frame,
//     (1436509052.249713) vcan0 044#2A366C2BBA R
// FD: ID##FDATA, F a hex digit of flags; extended and error frames have 8 digits of id. ` T` and ` R` at the
// end tell what the recorder sent and received; they may be missing (canplayer and log2asc take both). Times
// are written in microseconds, rounded down, as canplayer reads nine digits wrongly; nine digits are read
// (newer candump -N).
#pragma once

#include <cstdio>
#include <fstream>
#include <vector>

#include "dbc/ports/port.hpp"

namespace canhil {

/// One line of a log.
struct LogEntry {
  std::int64_t t_ns = 0;  ///< CLOCK_REALTIME in candump's logs
  std::string interface;
  Frame frame;
  bool transmitted = false;  ///< by the recorder
};

/// The line of an entry, without line end.
std::string format_log_line(const LogEntry& entry);

/// The entry of a line without its line end. Error: "WHERE:COLUMN: what was expected", columns from 1.
Result<LogEntry> parse_log_line(std::string_view line, std::string_view where);

/// Writes a log, buffered. A write that fails (disk full) makes close() tell.
class LogWriter {
 public:
  /// `final_name`: what it will be called, and is called in complaints, where that is another name.
  static Result<LogWriter> create(const std::string& path, const std::string& final_name = {});
  void write(const LogEntry& entry);
  /// Writes out what is buffered and ends the log.
  Result<void> close();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
  };
  LogWriter(std::FILE* file, std::string path) : file_(file), path_(std::move(path)) {}

  std::unique_ptr<std::FILE, CloseFile> file_;
  std::string path_;
  int error_ = 0;
};

/// Reads a log, strictly, line by line.
class LogReader {
 public:
  static Result<LogReader> open(const std::string& path);
  /// The next entry; nothing at the end. Error: "FILE:LINE:COLUMN: ...".
  Result<std::optional<LogEntry>> next();

 private:
  LogReader(std::ifstream file, std::string path) : file_(std::move(file)), path_(std::move(path)) {}

  /// A frame takes some 200 characters.
  static constexpr std::size_t longest_line = 4096;

  std::ifstream file_;
  std::string path_;
  std::vector<char> line_ = std::vector<char>(longest_line + 2);
  std::size_t line_number_ = 0;
};

/// Opens `log:FILE` as a bus on which only the recorded frames are: receive() gives them at once, with their
/// times (StampSource::process), and the port closes after the last. Nobody hears what send() takes. The
/// whole log is checked on opening.
Result<std::unique_ptr<Port>> open_log_port(std::string_view bus, const PortOptions& options);

}  // namespace canhil
