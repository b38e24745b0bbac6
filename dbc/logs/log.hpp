// Recorded frames in files of three formats. A writer takes the format from the file's name, a reader from
// the file's content:
//   *.pcap   libpcap's, link type SocketCAN, stamps in nanoseconds: tcpdump, Wireshark, tshark. It has
//   neither
//            names of interfaces nor who sent a frame
//   *.asc    Vector's ASCII log, stamps in microseconds: CANoe, CANalyzer, python-can. Of an error frame it
//   has
//            the time alone
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
  bool transmitted = false;  ///< by the recorder
};

/// Writes one format.
class LogSink {
 public:
  LogSink() = default;
  LogSink(const LogSink&) = delete;
  LogSink& operator=(const LogSink&) = delete;
  virtual ~LogSink() = default;
  virtual void write(const LogEntry& entry) = 0;
  /// The number of the error that stopped it; 0: all is written.
  virtual int close() = 0;
};

/// Reads one format.
class LogSource {
 public:
  LogSource() = default;
  LogSource(const LogSource&) = delete;
  LogSource& operator=(const LogSource&) = delete;
  virtual ~LogSource() = default;
  virtual Result<std::optional<LogEntry>> next() = 0;
};

/// Writes a log, buffered. A write that fails (disk full) makes close() fail.
class LogWriter {
 public:
  /// `final_name`: the name that the file will get, which decides the format and stands in messages; empty:
  /// `path`.
  static Result<LogWriter> create(const std::string& path, const std::string& final_name = {});
  void write(const LogEntry& entry) { sink_->write(entry); }
  /// Writes out what is buffered and ends the log.
  Result<void> close();

 private:
  LogWriter(std::unique_ptr<LogSink> sink, std::string path)
      : sink_(std::move(sink)), path_(std::move(path)) {}

  std::unique_ptr<LogSink> sink_;
  std::string path_;
};

/// Reads a log, strictly. Remote frames are left out: no message of a DBC is one.
class LogReader {
 public:
  static Result<LogReader> open(const std::string& path);
  /// The next entry; nothing at the end. Error: "FILE:LINE:COLUMN: ...", of pcap "FILE: packet N: ...".
  Result<std::optional<LogEntry>> next() { return source_->next(); }

 private:
  explicit LogReader(std::unique_ptr<LogSource> source) : source_(std::move(source)) {}

  std::unique_ptr<LogSource> source_;
};

}  // namespace canhil
