// Recorded frames in files of three formats. A writer chooses the format by the file's name, a reader by the
// file's content:
//   *.pcap   libpcap's, link type SocketCAN, stamps in nanoseconds: tcpdump, Wireshark, tshark. Does not
//            record interface names or the sender of a frame
//   *.asc    Vector's ASCII log, stamps in microseconds: CANoe, CANalyzer, python-can. Records only the time
//            of an error frame
//   others   candump's (candump.hpp), stamps in microseconds: can-utils, python-can
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"

namespace canhil {

/// One frame of a log.
struct LogEntry {
  std::int64_t t_ns = 0;  ///< CLOCK_REALTIME
  std::string interface;
  Frame frame;
  bool transmitted = false;  ///< sent by the recorder itself
};

/// Writes one format.
class LogSink {
 public:
  LogSink() = default;
  LogSink(const LogSink&) = delete;
  LogSink& operator=(const LogSink&) = delete;
  virtual ~LogSink() = default;
  /// Appends an entry; an error shows in close().
  virtual void write(const LogEntry& entry) = 0;
  /// The errno of the error that stopped writing; 0: everything is written.
  virtual int close() = 0;
};

/// Reads one format.
class LogSource {
 public:
  LogSource() = default;
  LogSource(const LogSource&) = delete;
  LogSource& operator=(const LogSource&) = delete;
  virtual ~LogSource() = default;
  /// The next entry; none at the end. Error: one line with its place.
  virtual Result<std::optional<LogEntry>> next() = 0;
};

/// Writes a log, buffered. A write that fails (disk full) makes close() fail.
class LogWriter {
 public:
  /// `final_name`: the name to which the caller will rename the file; it determines the format and appears in
  /// messages; empty: `path`.
  static Result<LogWriter> create(const std::string& path, const std::string& final_name = {});
  /// Appends an entry; an error shows in close().
  void write(const LogEntry& entry) { sink_->write(entry); }
  /// Flushes the buffer and ends the log.
  Result<void> close();

 private:
  LogWriter(std::unique_ptr<LogSink> sink, std::string path)
      : sink_(std::move(sink)), path_(std::move(path)) {}

  std::unique_ptr<LogSink> sink_;
  std::string path_;
};

/// Reads a log; a malformed line is an error. Remote frames are skipped: a DBC describes none.
class LogReader {
 public:
  /// Opens a log; its first bytes decide the format. Error: one line.
  static Result<LogReader> open(const std::string& path);
  /// The next entry; none at the end. Error: "FILE:LINE:COLUMN: ...", for pcap "FILE: packet N: ...".
  Result<std::optional<LogEntry>> next() { return source_->next(); }

 private:
  explicit LogReader(std::unique_ptr<LogSource> source) : source_(std::move(source)) {}

  std::unique_ptr<LogSource> source_;
};

}  // namespace canhil
