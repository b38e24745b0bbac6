// Logs of frames, in files of three formats. A writer chooses the format by the name of the file, a reader by
// the content of the file:
//   *.pcap   libpcap's format with link type SocketCAN, stamps in nanoseconds; for tcpdump, Wireshark and
//            tshark. Contains neither the names of interfaces nor whether the recorder sent a frame
//   *.asc    Vector's ASCII log, stamps in microseconds; for CANoe, CANalyzer and python-can. Of an error
//            frame, it contains only the time
//   *.log, *.txt, *.candump, and names without an ending
//            candump's format (candump.hpp), stamps in microseconds; for can-utils and python-can
// Any other ending would name a format that cannot be written.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"

namespace canhil {

/// One frame of a log.
struct LogEntry {
  std::int64_t t_ns = 0;  ///< time stamp of CLOCK_REALTIME
  std::string interface;
  Frame frame;
  bool transmitted = false;  ///< true: the recorder itself sent the frame
};

/// Base class: writes a log in one format.
class LogSink {
 public:
  LogSink() = default;
  LogSink(const LogSink&) = delete;
  LogSink& operator=(const LogSink&) = delete;
  virtual ~LogSink() = default;
  /// Appends an entry. If this fails, close() returns the error.
  virtual void write(const LogEntry& entry) = 0;
  /// Ends the log. Returns the errno of the error after which nothing more was written; 0: everything was
  /// written.
  virtual int close() = 0;
};

/// Base class: reads a log of one format.
class LogSource {
 public:
  LogSource() = default;
  LogSource(const LogSource&) = delete;
  LogSource& operator=(const LogSource&) = delete;
  virtual ~LogSource() = default;
  /// The next entry; nullopt: the log has ended. The error is one line that states the position in the file.
  virtual Result<std::optional<LogEntry>> next() = 0;
};

/// Writes a log, through a buffer. If a write fails (for example because the disk is full), close() returns
/// the error.
class LogWriter {
 public:
  /// Writes to a stream, and closes it. `name` is the name of the finished log: it determines the format and
  /// appears in error messages. Error: the ending of the name names no format that can be written.
  static Result<LogWriter> create(std::FILE* stream, std::string name);
  /// Appends an entry. If this fails, close() returns the error.
  void write(const LogEntry& entry) { sink_->write(entry); }
  /// Flushes the buffer and ends the log.
  Result<void> close();

 private:
  LogWriter(std::unique_ptr<LogSink> sink, std::string name)
      : name_(std::move(name)), sink_(std::move(sink)) {}

  std::string name_;
  std::unique_ptr<LogSink> sink_;
};

/// Reads a log. A malformed line is an error. Remote frames are skipped, because a DBC does not describe
/// them.
class LogReader {
 public:
  /// Opens a log. The first bytes of the file determine the format. An error is one line.
  static Result<LogReader> open(const std::string& path);
  /// The next entry; nullopt: the log has ended. An error begins with "FILE:LINE:COLUMN: ..."; for pcap it is
  /// "FILE: packet N: ...".
  Result<std::optional<LogEntry>> next() { return source_->next(); }

 private:
  explicit LogReader(std::unique_ptr<LogSource> source) : source_(std::move(source)) {}

  std::unique_ptr<LogSource> source_;
};

}  // namespace canhil
